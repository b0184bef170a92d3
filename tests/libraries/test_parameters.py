"""Parameter lists: a reference gives constants of a library other values, which hold everywhere in it."""

from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from linked_application import loaded

from tappet.codegen.build import BuildOptions, BuildResult, BuildSession, LibraryReference, build_application
from tappet.lang.ast import GlobalList
from tappet.lang.parser import parse
from tappet.lang.source import GivenValue, Source
from tappet.libraries import archive, catalog, load, repository, resolve
from tappet.libraries.archive import LibraryFileError
from tappet.project.library_reference import ParameterValue

PARAMETERS = """(* How much room there is. *)
{attribute 'qualified_only'}
{attribute 'parameter_list'}
VAR_GLOBAL CONSTANT
    cSlots  : INT := 4;          (* Places of the conveyor *)
    cText   : UDINT := 10;       (* Characters of a name *)
    cFull   : INT := cSlots * 2; (* Command that fills it *)
    cPause  : TIME := T#10ms;
    aStart  : ARRAY[0..1] OF INT := [1, 2];
    eMode   : BELT_MODE := BELT_MODE.Slow;
END_VAR
"""
MODE = "TYPE BELT_MODE : (Slow, Fast := 7); END_TYPE\n"
BELT = """FUNCTION_BLOCK Belt
VAR_INPUT nCommand : INT; END_VAR
VAR_OUTPUT nPlaces, nLength, nAnswer, nStart, nMode : INT; tPause : TIME; END_VAR
VAR
    aPlace : ARRAY[1..GVL_Belt.cSlots] OF INT;
    sName  : STRING(GVL_Belt.cText);
END_VAR
nPlaces := TO_INT(SIZEOF(aPlace) / 2);
nLength := TO_INT(SIZEOF(sName)) - 1;
CASE nCommand OF
    GVL_Belt.cSlots: nAnswer := 1;
    GVL_Belt.cFull: nAnswer := 2;
END_CASE
nStart := GVL_Belt.aStart[1];
nMode := GVL_Belt.eMode;
tPause := GVL_Belt.cPause;
END_FUNCTION_BLOCK
"""
TEXTS = {"GVL_Belt": PARAMETERS, "BELT_MODE": MODE, "Belt": BELT}
PROGRAM = """PROGRAM Main
VAR belt : Belt; n : INT; a : ARRAY[1..Conveyors.GVL_Belt.cSlots] OF BYTE; END_VAR
belt(nCommand := 6);
n := UPPER_BOUND(a, 1);
END_PROGRAM
"""
MANAGER = "PLC/Plc Logic/Application/Library Manager"


@pytest.fixture(autouse=True)
def conveyors(library_folder: Path) -> None:
    archive.install(archive.manifest("Conveyors", "1.0.0.0"), TEXTS)


def reference(name: str = "Conveyors", version: str = "*", **values: str) -> LibraryReference:
    parameters = tuple(ParameterValue("GVL_Belt", key, value) for key, value in values.items())
    return LibraryReference(name, version, parameters=parameters, place=MANAGER)


def build(
    *references: LibraryReference,
    text: str = PROGRAM,
    more: tuple[Source, ...] = (),
    check_only: bool = False,
    **options: object,
) -> BuildResult:
    libraries = (*references, LibraryReference("Standard"))
    chosen = BuildOptions(libraries=libraries, level=1, check_only=check_only)
    return build_application([Source("Main", text), *more], options=chosen, **options)


def values(result: BuildResult, *names: str) -> list[str]:
    assert [str(d) for d in result.diagnostics if d.severity == "error"] == []
    assert result.package is not None
    with loaded(result.package) as application:
        application.cycle()
        return [application.literal(f"Main.{name}") for name in names]


def messages(result: BuildResult) -> list[tuple[str, str]]:
    return [(d.code, d.uri) for d in result.diagnostics if d.severity != "info"]


def test_without_values_the_library_has_its_own() -> None:
    found = values(build(reference()), "belt.nPlaces", "belt.nLength", "belt.nAnswer", "n", "belt.tPause")
    assert found == ["4", "10", "0", "4", "T#10ms"]


def test_a_value_holds_in_bounds_lengths_labels_and_what_is_computed_from_it() -> None:
    used = reference(cSlots="3", cText="20", cPause="T#1s", aStart="[5, 6]", eMode="BELT_MODE.Fast")
    names = ("belt.nPlaces", "belt.nLength", "belt.nAnswer", "n", "belt.tPause", "belt.nStart", "belt.nMode")
    assert values(build(used), *names) == ["3", "20", "2", "3", "T#1s", "6", "7"]


def test_names_are_known_in_any_case_and_without_their_list() -> None:
    twincat = LibraryReference("Conveyors", parameters=(ParameterValue("GVL_BELT", "CSLOTS", "3"),))
    codesys = LibraryReference("Conveyors", parameters=(ParameterValue("", "CSLOTS", "3"),))
    assert values(build(twincat), "belt.nPlaces") == values(build(codesys), "belt.nPlaces") == ["3"]


def test_a_value_is_an_expression_of_what_the_application_declares() -> None:
    constants = Source(
        "GVL", "VAR_GLOBAL CONSTANT cLines : INT := 3; cSlots : INT := 90; END_VAR", name="GVL"
    )
    assert values(build(reference(cSlots="GVL.cLines * 2 + 1"), more=(constants,)), "belt.nPlaces") == ["7"]
    assert values(build(reference(cSlots="cLines"), more=(constants,)), "belt.nPlaces") == ["3"]
    both = reference(cSlots="cSlots", cFull="GVL_Belt.cSlots + 1")
    assert values(build(both, more=(constants,), text=PROGRAM.replace("6", "91")), "belt.nAnswer") == ["2"]


def test_an_edit_of_the_constant_that_a_value_names_reaches_the_library() -> None:
    session = BuildSession()

    def places(declared: str) -> list[str]:
        constants = Source("GVL", f"VAR_GLOBAL CONSTANT cLines : INT := {declared}; END_VAR", name="GVL")
        result = build(reference(cSlots="cLines"), more=(constants,), session=session)
        return values(result, "belt.nPlaces", "n")

    assert places("3") == ["3", "3"]
    assert places("5") == ["5", "5"]


def test_another_value_is_built_anew_and_changes_the_layout() -> None:
    session = BuildSession()
    first = build(reference(cSlots="3"), session=session)
    assert values(first, "belt.nPlaces") == ["3"]
    second = build(reference(cSlots="6"), session=session, previous=first.package)
    assert values(second, "belt.nPlaces") == ["6"]
    assert first.package is not None
    assert second.package is not None
    assert second.package.data_id != first.package.data_id
    assert second.package.code_id != first.package.code_id
    change = second.package.online_change
    assert change is not None
    assert change.base_code_id == first.package.code_id
    again = build(reference(cSlots="6"), session=session, previous=second.package)
    assert again.package is not None
    assert again.package.code_id == second.package.code_id
    renamed = replace(reference(cSlots="6"), place="Other/Library Manager")
    moved = build(renamed, session=session, previous=again.package)
    assert moved.package is not None
    assert moved.package.code_id == second.package.code_id
    label = build(reference(cSlots="6", cFull="7"), session=session, previous=second.package)
    assert label.package is not None
    assert label.package.code_id != second.package.code_id


def test_two_applications_have_values_of_their_own() -> None:
    few, many = build(reference(cSlots="2")), build(reference(cSlots="200"))
    assert values(few, "belt.nPlaces", "n") == ["2", "2"]
    assert values(many, "belt.nPlaces", "n") == ["200", "200"]


def test_two_versions_in_one_application_have_values_of_their_own() -> None:
    archive.install(archive.manifest("Conveyors", "2.0.0.0"), TEXTS)
    old = LibraryReference("Conveyors", "1.0.0.0", "Old", parameters=(ParameterValue("", "cSlots", "2"),))
    new = LibraryReference("Conveyors", parameters=(ParameterValue("", "cSlots", "9"),))
    text = "PROGRAM Main\nVAR a : Old.Belt; b : Conveyors.Belt; END_VAR\na(); b();\nEND_PROGRAM"
    assert values(build(old, new, text=text), "a.nPlaces", "b.nPlaces") == ["2", "9"]


@pytest.mark.parametrize(
    ("parameter", "value", "reason"),
    [
        ("cSlots", "'many'", "Cannot convert type 'STRING(4)' to type 'INT'"),
        ("cSlots", "40000", "Cannot convert"),
        ("cSlots", "Nowhere", "'Nowhere'"),
        ("cSlots", "nLines", "it is no constant"),
        ("cSlots", "GVL_Belt.cSlots", "it is no constant"),
        ("cSlots", "3 +", "expression expected"),
        ("cSlots", "3; END_VAR", "The end of the value expected before ';'"),
        ("cPause", "5", "Cannot convert"),
        ("aStart", "[1, 2, 3]", "3"),
        ("eMode", "BELT_MODE.Gone", "Gone"),
    ],
)
def test_a_value_that_does_not_suit_is_told_at_the_reference(parameter: str, value: str, reason: str) -> None:
    variables = Source("GVL", "VAR_GLOBAL nLines : INT := 3; END_VAR", name="GVL")
    result = build(reference(**{parameter: value}), more=(variables,))
    assert messages(result) == [("E0904", MANAGER)]
    message = result.diagnostics[0].message
    assert f"Library 'Conveyors', list 'GVL_Belt': the value '{value}'" in message
    assert f"parameter '{parameter}'" in message
    assert reason in message
    assert result.package is None


def test_a_value_that_does_not_suit_is_told_again_by_the_next_build() -> None:
    session = BuildSession()
    for text in (PROGRAM, PROGRAM, PROGRAM.replace("6", "7")):
        assert messages(build(reference(cSlots="TRUE"), text=text, session=session)) == [("E0904", MANAGER)]


def test_a_parameter_that_is_not_there_is_told_and_has_no_effect() -> None:
    newer = PARAMETERS.replace("cText  ", "cLength").replace(".cText", ".cLength")
    texts = TEXTS | {"GVL_Belt": newer, "Belt": BELT.replace("cText", "cLength")}
    archive.install(archive.manifest("Conveyors", "2.0.0.0"), texts)
    assert messages(build(reference(version="1.0.0.0", cText="20"))) == []
    result = build(reference(cText="20", cSlots="3"))
    assert values(result, "belt.nLength", "belt.nPlaces") == ["10", "3"]
    assert messages(result) == [("W1411", MANAGER)]
    message = result.diagnostics[0]
    assert message.message == (
        "Library 'Conveyors' has no parameter 'cText' in a list 'GVL_Belt': the value '20' has no effect"
    )
    close = build(reference(cSlot="3")).diagnostics[0]
    assert "Did you mean 'GVL_Belt.cSlots'?" in close.advice


def test_a_list_without_the_mark_has_no_parameters() -> None:
    plain = PARAMETERS.replace("{attribute 'parameter_list'}\n", "")
    archive.install(archive.manifest("Conveyors", "2.0.0.0"), TEXTS | {"GVL_Belt": plain})
    result = build(reference(cSlots="3"))
    assert messages(result) == [("W1411", MANAGER)]
    assert values(result, "belt.nPlaces") == ["4"]


USER = """FUNCTION_BLOCK Line
VAR_OUTPUT n : INT; END_VAR
VAR b : Belt; END_VAR
b();
n := b.nPlaces;
END_FUNCTION_BLOCK
"""


def test_a_library_asks_for_values_and_the_application_has_the_last_word() -> None:
    needed = {"name": "Conveyors", "parameters": [{"list": "GVL_Belt", "name": "cSlots", "value": "8"}]}
    archive.install(archive.manifest("Lines", "1.0.0.0", requires=[needed]), {"Line": USER})
    text = "PROGRAM Main\nVAR l : Line; END_VAR\nl();\nEND_PROGRAM"
    lines = LibraryReference("Lines")
    assert values(build(lines, text=text), "l.n") == ["8"]
    assert values(build(lines, reference(), text=text), "l.n") == ["8"]
    assert values(build(lines, reference(cSlots="2"), text=text), "l.n") == ["2"]
    requirement = repository.find("Lines").requires[0]
    assert requirement.parameters == (ParameterValue("GVL_Belt", "cSlots", "8"),)
    with pytest.raises(LibraryFileError, match="name and value"):
        archive.manifest("Lines", "1.0.0.0", requires=[{"name": "Conveyors", "parameters": [{"name": "x"}]}])


def test_what_a_library_offers_shows_its_parameters() -> None:
    item = next(x for x in catalog.items(load("Conveyors")) if x.kind == "parameter_list")
    assert (item.name, item.summary) == ("GVL_Belt", "How much room there is.")
    assert [(pin.name, pin.type, pin.default) for pin in item.members[:3]] == [
        ("cSlots", "INT", "4"),
        ("cText", "UDINT", "10"),
        ("cFull", "INT", "cSlots * 2"),
    ]
    assert item.members[0].comment == "Places of the conveyor"


def test_the_texts_of_a_library_without_values_are_those_of_all() -> None:
    """They are analysed once for all that give none, and never changed by one that does."""
    with_value, problems = resolve([reference(cSlots="3")])
    assert problems == []
    plain, _ = resolve([reference()])
    assert [source.given for source in plain[0].sources] == [(), (), ()]
    assert [len(source.given) for source in with_value[0].sources] == [0, 0, 1]


@pytest.mark.parametrize(
    "value",
    [
        "(" * 2000,
        "(" * 1000 + "1" + ")" * 1000,
        "1" + "+1" * 1999,
        "-" * 1500 + "1",
        "[" * 300,
        "(a := 1)",
        "ADR(GVL_Belt.cSlots)",
        "Belt",
        "Main",
        "Conveyors",
        "THIS^",
        "1 / 0",
        "SIZEOF(BELT_MODE)",
        "{error 'no'} 3",
        "3 (* not closed",
        "$",
        "\n\n",
        "Main.belt.nPlaces",
        "aStart[1]",
    ],
)
def test_whatever_is_typed_gives_a_program_or_a_message_at_the_reference(value: str) -> None:
    for parameter in ("cSlots", "aStart", "eMode", "cPause"):
        result = build(reference(**{parameter: value}), check_only=True)
        found = [d for d in result.diagnostics if d.severity == "error"]
        assert all((d.code, d.uri) == ("E0904", MANAGER) for d in found), [str(d) for d in found]


@given(st.text(max_size=60))
def test_no_text_of_a_value_hinders_the_parser(value: str) -> None:
    source = Source(
        "GVL_Belt", PARAMETERS, library="Conveyors", given=(GivenValue("cSlots", value, MANAGER),)
    )
    result = parse(source)
    (declared,) = result.unit.declarations
    assert isinstance(declared, GlobalList)
    assert len(declared.blocks[0].variables) == 6
    assert all((d.code, d.uri) == ("E0904", MANAGER) for d in result.diagnostics)
