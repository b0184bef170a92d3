"""`tappet import` and `tappet export` with the files of other systems."""

from __future__ import annotations

import json
import zipfile
from pathlib import Path

from tests.cli.invoke import invoke

SAMPLES = Path(__file__).parents[1] / "project" / "exchange" / "samples"


def tappet(*arguments: object) -> tuple[int, str]:
    done = invoke(*arguments)
    said = done.errors.removeprefix("tappet: ").rstrip("\n") if done.code == 2 else done.output
    return done.code, said


def test_a_twincat_project_comes_in_with_a_report_and_compiles(tmp_path: Path) -> None:
    code, said = tappet("import", SAMPLES / "twincat" / "Line.plcproj", "--to", tmp_path / "line")
    assert code == 0, said
    assert "Line.plcproj:11: refused POUs/Gone.TcPOU: the project lists this file" in said
    assert "Packing line: " in said.splitlines()[-1]
    code, said = tappet("check", tmp_path / "line", "--format", "json")
    errors = [item for item in json.loads(said)["diagnostics"] if item["severity"] == "error"]
    assert [(item["file"], item["code"]) for item in errors] == [("MAIN", "E0433")]
    assert errors[0]["message"].startswith("The body of MAIN is in FBD, which cannot be compiled yet")


def test_files_named_beside_their_project_are_read_once(tmp_path: Path) -> None:
    top = SAMPLES / "twincat"
    files = sorted(path for path in top.rglob("*") if path.is_file())
    assert tappet("import", top / "Line.plcproj", "--to", tmp_path / "project")[0] == 0
    code, said = tappet("import", *files, "--to", tmp_path / "files")
    assert code == 0
    assert "it is not part of the project" not in said
    objects = [
        {path.relative_to(folder) for path in folder.rglob("*.st")}
        for folder in (tmp_path / "project", tmp_path / "files")
    ]
    assert objects[0]
    assert objects[1] == objects[0]


def test_codesys_23_and_plain_texts_compile_as_they_are(tmp_path: Path) -> None:
    files = (SAMPLES / "plain.st", SAMPLES / "beremiz.xml", SAMPLES / "library.exp")
    for file, broken in zip(files, (set(), {"steps"}, {"NETWORKS"}), strict=True):
        folder = tmp_path / file.stem
        assert tappet("import", file, "--to", folder)[0] == 0
        found = json.loads(tappet("check", folder, "--format", "json")[1])["diagnostics"]
        assert {item["file"] for item in found if item["severity"] == "error"} == broken, found


def test_export_and_import_of_plcopen_xml_give_the_same_folder(tmp_path: Path) -> None:
    first, second, file = tmp_path / "first", tmp_path / "second", tmp_path / "mixer.xml"
    assert tappet("import", SAMPLES / "codesys_35.xml", "--to", first)[0] == 0
    assert tappet("export", first, "--to", file)[0] == 0
    assert tappet("import", file, "--to", second)[0] == 0
    left = {p.relative_to(first): p.read_bytes() for p in first.rglob("*") if p.is_file()}
    right = {p.relative_to(second): p.read_bytes() for p in second.rglob("*") if p.is_file()}
    assert right == left


def test_into_a_project_and_the_report_for_machines(tmp_path: Path) -> None:
    folder = tmp_path / "p"
    assert tappet("import", SAMPLES / "plain.st", "--to", folder)[0] == 0
    code, said = tappet("import", SAMPLES / "library.exp", "--to", folder, "--format", "json")
    answer = json.loads(said)
    assert code == 0
    assert answer["project"] == "plain"
    assert {"source", "line", "object", "outcome", "text", "object_id"} == set(answer["entries"][0])
    assert (folder / "Devices/Tappet Soft PLC/PLC Logic/Application/Blocks/STORE.st").is_file()
    assert (folder / "Devices/Tappet Soft PLC/PLC Logic/Application/FB_Lamp.st").is_file()


def test_wrong_usage_says_what_would_be_right(tmp_path: Path) -> None:
    bad = tmp_path / "bad.xml"
    bad.write_bytes(b"<project>\n<")
    assert tappet("import", bad, "--to", tmp_path / "a") == (
        2,
        "bad.xml:2: is no sound XML (unclosed token)",
    )
    assert tappet("import", tmp_path / "nothing.xml", "--to", tmp_path / "a")[0] == 2
    full = tmp_path / "full"
    full.mkdir()
    (full / "note.txt").write_text("x")
    assert "is not empty" in tappet("import", SAMPLES / "plain.st", "--to", full)[1]
    tappet("import", SAMPLES / "plain.st", "--to", tmp_path / "p")
    assert ".xml (PLCopen XML) or .zip" in tappet("export", tmp_path / "p", "--to", tmp_path / "x.txt")[1]


def test_an_archive_of_a_twincat_project_is_unpacked(tmp_path: Path) -> None:
    archive = tmp_path / "Line.tpzip"
    top = SAMPLES / "twincat"
    with zipfile.ZipFile(archive, "w") as packed:
        packed.writestr("Readme.md", "no code")
        for path in sorted(top.rglob("*")):
            if path.is_file():
                packed.write(path, path.relative_to(top).as_posix())
    code, said = tappet("import", archive, "--to", tmp_path / "line")
    assert code == 0, said
    assert "Readme" not in said
    assert "Packing line: " in said.splitlines()[-1]


def test_libraries_that_are_not_installed_are_named(tmp_path: Path) -> None:
    project = tmp_path / "Line.plcproj"
    names = ("Tc2_Standard", "Util", "Plant Parts")
    references = "".join(f'<PlaceholderReference Include="{name}"/>' for name in names)
    project.write_text(f"<Project><ItemGroup>{references}</ItemGroup></Project>")
    code, said = tappet("import", project, "--to", tmp_path / "line")
    assert code == 0, said
    lines = [line for line in said.splitlines() if "not installed" in line]
    assert len(lines) == 1
    assert (
        "kept Plant Parts: the library is not installed: what it declares is unknown until it is" in lines[0]
    )


def test_a_full_disk_is_said_in_a_sentence(tmp_path: Path) -> None:
    source = tmp_path / "a.st"
    source.write_text("PROGRAM Main\nVAR n : INT; END_VAR\nn := n + 1;\nEND_PROGRAM\n")
    done = tappet("run", source, "--virtual", "--cycles", 2, "--trace", "/dev/full", "--print", "Main.n")
    assert done == (2, "the disk is full: /dev/full was not written")


def test_what_becomes_of_objects_that_exist(tmp_path: Path) -> None:
    pump = tmp_path / "Pump.st"
    pump.write_text("FUNCTION_BLOCK FB_Pump\nVAR\n  a : INT;\nEND_VAR\nEND_FUNCTION_BLOCK\n")
    project = tmp_path / "p"
    assert tappet("import", pump, "--to", project)[0] == 0
    (file,) = project.rglob("FB_Pump.st")
    pump.write_text(pump.read_text().replace("  a : INT;\n", "  a : INT;\n  b : INT;\n"))
    assert "FB_Pump: exists already" in tappet("import", pump, "--to", project, "--existing", "skip")[1]
    assert "b : INT" not in file.read_text()
    code, said = tappet("import", pump, "--to", project, "--existing", "merge")
    assert (code, "(1 merged)" in said) == (0, True)
    assert "b : INT" in file.read_text()
    pump.write_text("FUNCTION_BLOCK FB_Pump\nEND_FUNCTION_BLOCK\n")
    assert "(1 overwritten)" in tappet("import", pump, "--to", project, "--existing", "overwrite")[1]
    assert "b : INT" not in file.read_text()
    assert "(1 imported, 1 changed)" in tappet("import", pump, "--to", project)[1]
    assert tappet("import", pump, "--to", project, "--existing", "destroy")[0] == 2
