"""Versions side by side, references, placeholders, requirements, library files."""

import io
import json
import zipfile
from contextlib import suppress
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from linked_application import loaded

from tappet.codegen.build import BuildOptions, LibraryReference, build_application
from tappet.lang.source import Source
from tappet.libraries import UnknownLibraryError, archive, every_version, load, names, repository, resolve
from tappet.libraries.archive import LibraryFileError


def block(step: int) -> str:
    """A library text: a counter whose result shows its version."""
    return (
        f"(* Counts by {step}. *)\nFUNCTION_BLOCK Counter\nVAR_OUTPUT\n    n : INT; (* Count *)\nEND_VAR\n"
        f"VAR\n    state : State;\nEND_VAR\nstate.count := state.count + {step};\nn := state.count;\n"
        "END_FUNCTION_BLOCK\n"
    )


STATE = "(* State. *)\nTYPE State :\nSTRUCT\n    count : INT; (* Count *)\nEND_STRUCT\nEND_TYPE\n"


def install(name: str, version: str, step: int = 1, **facts: object) -> None:
    texts = {"Counter": block(step), "State": STATE}
    archive.install({**archive.manifest(name, version, company="Plant"), **facts}, texts)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("Util, * (Tappet)", ("Util", "*", "Tappet")),
        ("Util, 3.5.0.0 (Tappet)", ("Util", "3.5.0.0", "Tappet")),
        ("Util", ("Util", "*", None)),
        (
            "Tc2_Standard, 3.3.3.0 (Beckhoff Automation GmbH)",
            ("Tc2_Standard", "3.3.3.0", "Beckhoff Automation GmbH"),
        ),
        ("My Library, 1.0", ("My Library", "1.0", None)),
    ],
)
def test_references_as_they_are_written(text: str, expected: tuple[str, str, str | None]) -> None:
    found = repository.designation(text)
    assert (found.name, found.version, found.company) == expected


def test_newest_counts_by_numbers_and_every_version_stays_reachable() -> None:
    for version, step in (("1.9.0.0", 9), ("1.10.0.0", 10), ("1.2.0.0", 2)):
        install("Plant", version, step)
    assert load("Plant").version == "1.10.0.0"
    assert load("plant, * (Plant)").version == "1.10.0.0"
    assert load("Plant", "1.2.0.0").version == "1.2.0.0"
    assert load("Plant, 1.9.0.0 (Plant)").version == "1.9.0.0"
    assert [x.version for x in every_version() if x.name == "Plant"] == ["1.10.0.0", "1.9.0.0", "1.2.0.0"]
    assert names().count("Plant") == 1
    with pytest.raises(
        UnknownLibraryError, match=r"version 1\.10\.0\.0 and 1\.9\.0\.0 and 1\.2\.0\.0, not 7"
    ):
        load("Plant", "7")
    with pytest.raises(UnknownLibraryError):
        load("Plant, * (Somebody else)")


def test_installing_again_replaces_and_removing_brings_the_one_before_back() -> None:
    install("Plant", "1.0.0.0", 1)
    assert "+ 1;" in load("Plant").sources[0].text
    install("Plant", "1.0.0.0", 5)
    assert "+ 5;" in load("Plant").sources[0].text
    install("Plant", "2.0.0.0", 7)
    assert "+ 7;" in load("Plant").sources[0].text
    archive.remove("Plant", "2.0.0.0")
    assert load("Plant").version == "1.0.0.0"
    archive.remove("Plant", "1.0.0.0")
    with pytest.raises(UnknownLibraryError):
        load("Plant")


def test_libraries_of_the_product_stay() -> None:
    version = load("Util").version
    with pytest.raises(LibraryFileError, match="comes with Tappet"):
        archive.remove("Util", version)
    with pytest.raises(LibraryFileError, match="comes with Tappet"):
        install("Util", version)


def test_a_placeholder_of_another_system_finds_ours_under_its_own_namespace() -> None:
    library = load("Tc2_Standard, * (Beckhoff Automation GmbH)")
    assert (library.name, library.namespace) == ("Standard", "Tc2_Standard")
    assert load("Tc2_Standard, 3.3.3.0 (Beckhoff Automation GmbH)").name == "Standard"
    assert load("Standard, * (System)").namespace == "Standard"
    text = (
        "PROGRAM Main\nVAR t : Tc2_Standard.TON; u : TON; END_VAR\nt(PT := T#1s); u(PT := T#2s);\nEND_PROGRAM"
    )
    reference = LibraryReference("Tc2_Standard, * (Beckhoff Automation GmbH)")
    result = build_application([Source("m", text)], options=BuildOptions(libraries=(reference,)))
    assert [str(d) for d in result.diagnostics if d.severity == "error"] == []


def test_a_library_of_another_system_that_is_two_of_ours_has_one_namespace() -> None:
    text = (
        "PROGRAM Main\nVAR t : Tc2_Standard.TON; i, j : INT; w, x : WSTRING(20); END_VAR\n"
        'i := Tc2_Standard.WLEN("four"); j := WFIND("abcd", "cd"); w := WCONCAT(WLEFT("machine", 3), '
        'WRIGHT("plant", 2)); w := WINSERT(WMID(w, 4, 1), "-", 2); x := WREPLACE(WDELETE("abcdef", 2, 1), '
        '"XY", 1, 2);\nEND_PROGRAM'
    )
    beckhoff = LibraryReference("Tc2_Standard, * (Beckhoff Automation GmbH)")
    renamed = LibraryReference("Standard", namespace="Tc2_Standard")
    own = LibraryReference("Standard64")
    expected = ["4", "3", '"ma-cn"', '"cXYef"']
    assert _run(text, [beckhoff], ["i", "j", "w", "x"]) == expected
    assert _run(text, [renamed], ["i", "j", "w", "x"]) == expected
    assert _run(text.replace("Tc2_Standard.WLEN", "WLEN"), [beckhoff, own], ["i", "j", "w", "x"]) == expected


@pytest.mark.parametrize(
    "name",
    [
        "CAA Types, * (CAA Technical Workgroup)",
        "CAA Types, 3.5.17.0 (System)",
        "CAA Types Extern, 3.5.13.0 (CAA Technical Workgroup)",
    ],
)
def test_a_name_of_several_words_gives_the_namespace_of_the_library(name: str) -> None:
    text = "PROGRAM Main\nVAR n : CAA.SIZE; u : UDINT; END_VAR\nn := 70000;\n"
    text += "u := CAA.SIZE_TO_UDINT(n);\nEND_PROGRAM"
    assert _run(text, [LibraryReference(name)], ["u"]) == ["70000"]


def test_base_interfaces_under_both_names() -> None:
    text = "FUNCTION_BLOCK B IMPLEMENTS {}IBase\nMETHOD AddRef : DINT\nEND_METHOD\nMETHOD Release : DINT\n"
    text += "END_METHOD\nMETHOD QueryInterface : POINTER TO BYTE\nVAR_INPUT iid : UDINT; "
    text += "pResult : POINTER TO UDINT; END_VAR\nEND_METHOD\nEND_FUNCTION_BLOCK\n"
    text += "PROGRAM Main\nVAR b : B; i : {}IBase; t : TypeClass; END_VAR\n"
    text += "i := b; t := TypeClass.TYPE_INT;\nEND_PROGRAM"
    own = text.format("IBaseLibrary.", "IBaseLibrary.")
    assert _run(own, [LibraryReference("IBaseLibrary, 3.5.2.0 (System)")], ["t"]) == ["TYPE_INT"]
    plain = text.format("", "")
    assert _run(plain, [LibraryReference("Base Interfaces, * (System)")], ["t"]) == ["TYPE_INT"]


def test_two_versions_in_one_application_under_two_namespaces() -> None:
    install("Plant", "1.0.0.0", 1)
    install("Plant", "2.0.0.0", 20)
    text = (
        "PROGRAM Main\nVAR a : PlantOld.Counter; b : Plant.Counter; s : PlantOld.State; END_VAR\n"
        "a(); b(); b(); s.count := a.n;\nEND_PROGRAM"
    )
    old, new = LibraryReference("Plant", "1.0.0.0", "PlantOld"), LibraryReference("Plant")
    assert _run(text, [old, new], ["a.n", "b.n", "s.count"]) == ["1", "40", "1"]


def _run(text: str, libraries: list[LibraryReference], names: list[str]) -> list[str]:
    """Values of expressions after one cycle."""
    result = build_application([Source("m", text)], options=BuildOptions(libraries=tuple(libraries)))
    assert [str(d) for d in result.diagnostics if d.severity == "error"] == []
    assert result.package is not None
    with loaded(result.package) as application:
        application.cycle()
        return [application.literal(f"Main.{name}") for name in names]


def _install_user(name: str, base: str, **requirement: str) -> None:
    """A library whose block counts by those of a version of 'Plant', by its plain and its qualified name."""
    text = (
        f"FUNCTION_BLOCK {name}Count\nVAR_OUTPUT\n    n : INT;\nEND_VAR\n"
        f"VAR\n    a : Counter;\n    b : {requirement.get('namespace', 'Plant')}.Counter;\n"
        "    c : Plant.State;\nEND_VAR\n"
        "a();\nb();\nc.count := a.n + b.n;\nn := c.count;\nEND_FUNCTION_BLOCK\n"
    )
    facts = archive.manifest(name, "1.0.0.0", requires=[{"name": "Plant", "version": base, **requirement}])
    archive.install(facts, {f"{name}Count": text})


def test_a_library_keeps_its_version_beside_that_of_the_application() -> None:
    for version, step in (("1.0.0.0", 1), ("2.0.0.0", 20), ("3.0.0.0", 300)):
        install("Plant", version, step)
    _install_user("Old", "1.0.0.0")
    _install_user("Middle", "2.0.0.0", namespace="Works")
    _install_user("Any", "*")
    text = (
        "PROGRAM Main\nVAR a : Counter; b : Plant.Counter; old : OldCount; mid : Middle.MiddleCount;\n"
        "any_ : AnyCount; inner : Old.Plant.Counter; END_VAR\n"
        "a(); b(); old(); mid(); any_(); inner();\nEND_PROGRAM"
    )
    used = [LibraryReference(name) for name in ("Plant", "Old", "Middle", "Any")]
    found = _run(text, used, ["a.n", "b.n", "old.n", "mid.n", "any_.n", "inner.n"])
    assert found == ["300", "300", "2", "40", "600", "1"]
    hidden = "PROGRAM Main\nVAR a : Plant_1_0_0_0.Counter; END_VAR\na();\nEND_PROGRAM"
    result = build_application([Source("m", hidden)], options=BuildOptions(libraries=tuple(used)))
    assert [d.code for d in result.diagnostics if d.severity == "error"]


def test_libraries_that_need_two_versions_of_a_third_one_that_the_application_does_not_name() -> None:
    install("Plant", "1.0.0.0", 1)
    install("Plant", "2.0.0.0", 20)
    _install_user("Old", "1.0.0.0")
    _install_user("New", "2.0.0.0")
    text = "PROGRAM Main\nVAR old : OldCount; new_ : NewCount; END_VAR\nold(); new_();\nEND_PROGRAM"
    for order in (("Old", "New"), ("New", "Old")):
        found = _run(text, [LibraryReference(name) for name in order], ["old.n", "new_.n"])
        assert found == ["2", "40"]


def test_the_application_resolves_a_placeholder_for_its_libraries() -> None:
    install("Plant", "1.0.0.0", 1)
    install("Plant", "2.0.0.0", 20)
    text = (
        "FUNCTION_BLOCK UserCount\nVAR c : Conveyors.Counter; END_VAR\nVAR_OUTPUT n : INT; END_VAR\n"
        "c();\nn := c.n;\nEND_FUNCTION_BLOCK\n"
    )
    archive.install(
        archive.manifest("User", "1.0.0.0", requires=[{"name": "Conveyors"}]), {"UserCount": text}
    )
    main = "PROGRAM Main\nVAR u : UserCount; c : Conveyors.Counter; END_VAR\nu(); c();\nEND_PROGRAM"
    for version, step in (("1.0.0.0", "1"), ("2.0.0.0", "20")):
        resolved = LibraryReference("Plant", version, placeholder="Conveyors")
        assert _run(main, [LibraryReference("User"), resolved], ["u.n", "c.n"]) == [step, step]
    _, problems = resolve([LibraryReference("User")])
    assert "'User' needs it: library 'Conveyors' is not installed" in problems[0].message


def test_two_versions_under_one_namespace_are_refused() -> None:
    install("Plant", "1.0.0.0")
    install("Plant", "2.0.0.0")
    _, problems = resolve([LibraryReference("Plant", "1.0.0.0"), LibraryReference("Plant")])
    assert len(problems) == 1
    assert "give one of them another namespace" in problems[0].message


def test_what_a_library_needs_comes_with_it() -> None:
    install("Base", "1.0.0.0")
    install("Base", "2.0.0.0")
    install("User", "1.0.0.0", requires=[{"name": "Base"}, {"name": "Standard"}])
    found, problems = resolve([LibraryReference("User")])
    assert [(x.name, x.version) for x in found][1:] == [
        ("Base", "2.0.0.0"),
        ("Standard", load("Standard").version),
    ]
    assert problems == []
    found, problems = resolve([LibraryReference("Base", "1.0.0.0"), LibraryReference("User")])
    assert [x.version for x in found if x.name == "Base"] == ["1.0.0.0"]
    install("Exact", "1.0.0.0", requires=[{"name": "Base", "version": "2.0.0.0"}])
    found, problems = resolve([LibraryReference("Base", "1.0.0.0"), LibraryReference("Exact")])
    assert problems == []
    assert [(x.version, x.namespace) for x in found if x.name == "Base"] == [
        ("1.0.0.0", "Base"),
        ("2.0.0.0", "Base_2_0_0_0"),
    ]
    install("Lost", "1.0.0.0", requires=[{"name": "Nowhere"}])
    _, problems = resolve([LibraryReference("Lost")])
    assert problems[0].message.startswith("'Lost' needs it: library 'Nowhere' is not installed")


def test_a_library_file_comes_back_and_is_stable() -> None:
    facts = archive.manifest("Plant", "1.2.0.0", namespace="PL", description="Conveyors")
    data = archive.pack(facts, {"State": STATE, "Counter": block(1)})
    assert data == archive.pack(facts, {"Counter": block(1), "State": STATE})
    assert archive.unpack(data) == (facts, {"Counter": block(1), "State": STATE})


def test_a_broken_manifest_hides_no_other_library(library_folder: Path) -> None:
    install("Plant", "1.0.0.0")
    (library_folder / "Bad" / "1.0").mkdir(parents=True)
    (library_folder / "Bad" / "1.0" / "library.json").write_text("{")
    assert "Plant" in names()


@pytest.mark.parametrize(
    ("files", "message"),
    [
        ({}, "no library.json"),
        ({"library.json": "{"}, "library.json:"),
        ({"library.json": "[]"}, "no object"),
        ({"library.json": '{"name": "../x", "version": "1.0"}'}, "none for a library"),
        ({"library.json": '{"name": "x", "version": "one"}'}, "write it like 1.2.0.0"),
        ({"library.json": '{"name": "x", "version": "1.0", "namespace": "a b"}'}, "no identifier"),
        (
            {"library.json": '{"name": "x", "version": "1.0"}', "../evil.st": ""},
            "does not stay in the folder",
        ),
        ({"library.json": '{"name": "x", "version": "1.0"}', "f/g.st": ""}, "no ST file"),
        ({"library.json": '{"name": "x", "version": "1.0"}', "run.sh": ""}, "no ST file"),
    ],
)
def test_bad_library_files_are_refused_with_a_reason(files: dict[str, str], message: str) -> None:
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w") as zipped:
        for name, text in files.items():
            zipped.writestr(name, text)
    with pytest.raises(LibraryFileError, match=message):
        archive.unpack(out.getvalue())


def test_a_bomb_is_not_unpacked(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(archive, "MAX_BYTES", 1000)
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as zipped:
        zipped.writestr(
            "library.json", json.dumps({"name": "x", "version": "1.0", "description": "x" * 2000})
        )
    with pytest.raises(LibraryFileError, match="more than"):
        archive.unpack(out.getvalue())


@given(st.binary(max_size=200), st.integers(0, 400), st.binary(min_size=1, max_size=4))
def test_damaged_library_files_never_raise_anything_else(data: bytes, at: int, patch: bytes) -> None:
    good = archive.pack(archive.manifest("Plant", "1.0"), {"Counter": block(1)})
    for candidate in (data, good[:at] + patch + good[at + len(patch) :]):
        with suppress(LibraryFileError):
            facts, _ = archive.unpack(candidate)
            assert facts["name"] == "Plant"
