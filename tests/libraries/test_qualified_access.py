"""Libraries whose names are used with the namespace only (LIB-08)."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from linked_application import loaded

from tappet.codegen.build import (
    BuildOptions,
    BuildResult,
    BuildSession,
    LibraryReference,
    build_application,
)
from tappet.lang.services.code_actions import code_actions
from tappet.lang.services.completion import complete
from tappet.lang.services.documents import Position, Program, library_text, whole_file
from tappet.lang.services.hover import hover
from tappet.lang.services.workspace import Workspace
from tappet.lang.source import Source, Span
from tappet.libraries import archive, load, resolve
from tappet.libraries.archive import LibraryFileError

TEXTS = {
    "Open": (
        "FUNCTION_BLOCK Open EXTENDS Base IMPLEMENTS I_Open\nVAR_INPUT eMode : MODE; END_VAR\n"
        "VAR_OUTPUT n : INT; END_VAR\nn := Twice(cStep) + MODE.MREAD;\nEND_FUNCTION_BLOCK\n"
    ),
    "Base": "FUNCTION_BLOCK Base\nEND_FUNCTION_BLOCK\n",
    "I_Open": "INTERFACE I_Open\nEND_INTERFACE\n",
    "MODE": "{attribute 'qualified_only'}\nTYPE MODE : (MWRITE, MREAD); END_TYPE\n",
    "LEVEL": "TYPE LEVEL : (Low := 3, High := 5); END_TYPE\n",
    "Twice": "FUNCTION Twice : INT\nVAR_INPUT n : INT; END_VAR\nTwice := 2 * n;\nEND_FUNCTION\n",
    "ABS": "FUNCTION ABS : INT\nVAR_INPUT n : INT; END_VAR\nABS := 99;\nEND_FUNCTION\n",
    "Steps": "VAR_GLOBAL CONSTANT cStep : INT := 7; END_VAR\n",
    "Hidden": "FUNCTION INTERNAL Hidden : INT\nEND_FUNCTION\n",
}


@pytest.fixture(autouse=True)
def files(library_folder: Path) -> None:
    archive.install(archive.manifest("Plant File", "1.0.0.0", namespace="FILE", qualified_only=True), TEXTS)


def build(text: str, *more: str) -> BuildResult:
    used = (LibraryReference("Plant File"), LibraryReference("Standard"))
    sources = [Source(f"t{number}", one) for number, one in enumerate((text, *more))]
    return build_application(sources, options=BuildOptions(libraries=used))


def errors(text: str) -> list[tuple[str, str]]:
    return [(d.code, d.advice) for d in build(text).diagnostics if d.severity == "error"]


def values(result: BuildResult, *names: str) -> list[str]:
    assert [str(d) for d in result.diagnostics if d.severity == "error"] == []
    assert result.package is not None
    with loaded(result.package) as application:
        application.cycle()
        return [application.literal(f"Main.{name}") for name in names]


def workspace(text: str) -> Workspace:
    libraries, _ = resolve([LibraryReference("Plant File")])
    texts = [library_text(source) for library in libraries for source in library.sources]
    return Workspace(lambda unsaved: [Program("App", [whole_file("Main", Source("Main", text)), *texts])])


@pytest.mark.parametrize(
    ("declared", "statement", "choice"),
    [
        ("fb : Open;", "fb();", "FILE.Open"),
        ("p : POINTER TO Open;", "p := 0;", "FILE.Open"),
        ("i : I_Open;", "i := 0;", "FILE.I_Open"),
        ("e : MODE;", "e := 0;", "FILE.MODE"),
        ("n : INT;", "n := Twice(n);", "FILE.Twice"),
        ("n : INT;", "n := cStep;", "FILE.cStep"),
        ("n : INT;", "n := High;", "FILE.High"),
        ("n : INT;", "n := MODE.MREAD;", "FILE.MODE"),
        ("n : INT;", "n := MREAD;", "FILE.MODE.MREAD"),
    ],
)
def test_a_name_without_the_namespace_is_refused_with_the_whole_name(
    declared: str, statement: str, choice: str
) -> None:
    found = errors(f"PROGRAM Main\nVAR {declared} END_VAR\n{statement}\nEND_PROGRAM")
    advice = f"Write '{choice}': the names of library 'Plant File' are used with its namespace only."
    assert found == [("E0220", advice)]


@pytest.mark.parametrize("head", ["FUNCTION_BLOCK FB EXTENDS Open", "FUNCTION_BLOCK FB IMPLEMENTS I_Open"])
def test_heads_of_blocks_need_the_namespace_as_well(head: str) -> None:
    assert [code for code, _ in errors(f"{head}\nEND_FUNCTION_BLOCK")] == ["E0220"]
    known = head.replace(" Open", " FILE.Open").replace(" I_Open", " FILE.I_Open")
    assert errors(f"{known}\nEND_FUNCTION_BLOCK") == []


def test_with_the_namespace_everything_works_and_the_library_names_itself_plainly() -> None:
    text = (
        "PROGRAM Main\nVAR fb : FILE.Open; e : FILE.MODE := FILE.MODE.MREAD; n, m, k : INT; END_VAR\n"
        "fb(eMode := e); n := FILE.Twice(FILE.cStep) + fb.n; m := FILE.High; k := ABS(-4);\nEND_PROGRAM"
    )
    assert values(build(text), "n", "m", "k") == ["29", "5", "4"]


def test_what_the_project_calls_alike_is_meant_and_not_ambiguous() -> None:
    own = "FUNCTION Twice : INT\nVAR_INPUT n : INT; END_VAR\nTwice := 20 * n;\nEND_FUNCTION"
    text = "PROGRAM Main\nVAR n, m : INT; END_VAR\nn := Twice(1); m := FILE.Twice(1);\nEND_PROGRAM"
    assert values(build(text, own), "n", "m") == ["20", "2"]


def test_two_such_libraries_and_a_plain_one_are_no_ambiguity() -> None:
    again = archive.manifest("Other File", "1.0.0.0", namespace="OTHER", qualified_only=True)
    archive.install(again, {**TEXTS, "TON": "FUNCTION_BLOCK TON\nEND_FUNCTION_BLOCK\n"})
    used = tuple(LibraryReference(name) for name in ("Other File", "Plant File", "Standard"))
    text = (
        "PROGRAM Main\nVAR t : TON; o : OTHER.TON; a, b : INT; END_VAR\nt(IN := TRUE); o();\n"
        "a := OTHER.Twice(1); b := FILE.Twice(2);\nEND_PROGRAM"
    )
    result = build_application([Source("m", text)], options=BuildOptions(libraries=used))
    assert values(result, "a", "b") == ["2", "4"]


def test_a_reference_can_ask_for_it_where_the_library_does_not() -> None:
    archive.install(
        archive.manifest("Open Plant", "1.0.0.0"), {"Thrice": TEXTS["Twice"].replace("Twice", "Thrice")}
    )
    text = "PROGRAM Main\nVAR n : INT; END_VAR\nn := {}Thrice(1);\nEND_PROGRAM"

    def codes(text: str, qualified_only: bool) -> list[str]:
        used = (LibraryReference("Open Plant", qualified_only=qualified_only),)
        result = build_application([Source("m", text)], options=BuildOptions(libraries=used))
        return [d.code for d in result.diagnostics if d.severity == "error"]

    assert codes(text.format(""), False) == []
    assert codes(text.format(""), True) == ["E0220"]
    assert codes(text.format("Open_Plant."), True) == []


def test_what_a_reference_asks_for_holds_for_the_application_alone() -> None:
    archive.install(archive.manifest("Base", "1.0.0.0"), {"Step": TEXTS["Twice"].replace("Twice", "Step")})
    user = "FUNCTION {0} : INT\n{0} := Step(3);\nEND_FUNCTION\n"
    for name, more in (("Free", {}), ("Strict", {"qualified_only": True})):
        facts = archive.manifest(name, "1.0.0.0", requires=[{"name": "Base", **more}])
        archive.install(facts, {f"F{name}": user.format(f"F{name}")})

    def codes(name: str) -> list[str]:
        used = (LibraryReference(name), LibraryReference("Base", qualified_only=True))
        text = f"PROGRAM Main\nVAR n : INT; END_VAR\nn := F{name}();\nEND_PROGRAM"
        result = build_application([Source("m", text)], options=BuildOptions(libraries=used))
        return [d.code for d in result.diagnostics if d.severity == "error"]

    assert codes("Free") == []
    assert codes("Strict") == ["E0220"]


def test_completion_offers_the_namespace_and_everything_behind_it() -> None:
    def labels(declared: str, statement: str) -> set[str]:
        text = f"PROGRAM Main\nVAR e : FILE.MODE; {declared}END_VAR\n{statement}\nEND_PROGRAM"
        line = len(text.splitlines()) - 2
        return {item.label for item in complete(workspace(text), "Main", Position(line, len(statement)))}

    plain = labels("", "")
    assert "FILE" in plain
    assert not plain & set(TEXTS) - {"ABS"}
    assert {"Open", "Twice", "MODE", "Steps", "cStep", "High"} <= labels("", "e := FILE.")
    assert "Hidden" not in labels("", "e := FILE.")
    assert {"FILE.MODE.MREAD", "FILE.MODE.MWRITE"} <= labels("", "e := ")
    assert "MODE.MREAD" not in labels("", "e := ")


def test_the_message_is_mended_by_the_whole_name() -> None:
    text = "PROGRAM Main\nVAR fb : Open; e : FILE.MODE; END_VAR\nfb(); eOther := e;\nEND_PROGRAM"
    found = code_actions(workspace(text).snapshot("Main"), "Main", Span(0, 0, 4, 0))
    edits = [edit for action in found for edit in action.edits if action.report.code == "E0220"]
    assert [edit.text for edit in edits] == ["FILE.Open"]
    assert any(action.title == "Declare 'eOther' as FILE.MODE" for action in found)


def test_hovering_shows_what_stands_behind_the_namespace() -> None:
    text = "PROGRAM Main\nVAR fb : FILE.Open; n : INT; END_VAR\nn := FILE.MODE.MREAD;\nEND_PROGRAM"
    shown = hover(workspace(text).snapshot("Main"), "Main", Position(1, 16))
    assert shown is not None
    assert "FUNCTION_BLOCK Open" in shown.code


def test_the_flag_comes_back_from_a_library_file() -> None:
    facts = archive.manifest("Plant File", "1.0.0.0", namespace="FILE", qualified_only=True)
    read, texts = archive.unpack(archive.pack(facts, TEXTS))
    assert (read["qualified_only"], texts) == (True, TEXTS)
    assert "qualified_only" not in archive.manifest("Plant", "1.0.0.0")
    assert load("Plant File").qualified_only
    assert not load("Standard").qualified_only


@pytest.mark.parametrize(
    "facts", [{"qualified_only": "yes"}, {"requires": [{"name": "Standard", "qualified_only": 1}]}]
)
def test_a_flag_that_is_none_is_refused(facts: dict[str, object]) -> None:
    manifest = {**archive.manifest("Plant", "1.0.0.0"), **facts}
    assert json.dumps(manifest)
    with pytest.raises(LibraryFileError, match="'qualified_only' has to be true or false"):
        archive.install(manifest, TEXTS)


def test_what_is_internal_in_a_library_is_not_offered_behind_its_type() -> None:
    """CamFileSection of SM3_Basic is INTERNAL and has a value of this name."""
    source = Source("Main", "PROGRAM Main\nVAR n : INT; END_VAR\nn := Nothing;\nEND_PROGRAM")
    options = BuildOptions(libraries=(LibraryReference("SM3_Basic"),))
    result = build_application([source], options=options, session=BuildSession())
    assert [d.code for d in result.diagnostics if d.severity == "error"] == ["E0201"]
