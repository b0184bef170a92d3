"""The folder format: readable, byte-stable, and nothing is lost (architecture, decision 9; CON-03)."""

from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from project_strategies import TEXTS, projects
from tests.project.project_paths import at

from tappet.project import edit
from tappet.project.errors import FolderFormatError
from tappet.project.folder import decode, encode, load, save
from tappet.project.folder.filenames import MAX_STEM_BYTES, name_of, stem_of
from tappet.project.folder.layout import derived_id
from tappet.project.folder.texts import Parts, read_text, write_text
from tappet.project.kind_registry import kinds
from tappet.project.model import Project, ProjectObject, new_id
from tappet.project.naming import name_key
from tappet.project.new_project import new_project
from tappet.project.object_kind import IecText
from tappet.project.objects import make_object

APP = "Devices/Tappet Soft PLC/PLC Logic/Application"


def motor() -> Project:
    project = new_project("Press", "line 3")
    application = at(project, APP.removeprefix("Devices/"))
    declaration = "FUNCTION_BLOCK FB_Motor\nVAR\n    rSpeed : REAL;\nEND_VAR"
    project, block = edit.add_object(
        project,
        application.id,
        "pou",
        "FB_Motor",
        data={"declaration": declaration, "implementation": "Start();"},
    )
    project, _ = edit.add_object(
        project, block.id, "action", "Start", data={"implementation": "rSpeed := 1;"}
    )
    project, speed = edit.add_object(project, block.id, "property", "Speed")
    getter = project.children(speed.id)[0]
    return edit.change_data(project, getter.id, {"implementation": "Speed := TRUE;"})


def test_values_for_parameters_of_libraries_are_kept_and_others_leave_no_trace() -> None:
    project = new_project("Press")
    manager = at(project, f"{APP.removeprefix('Devices/')}/Library Manager")
    path = f"{APP}/Library Manager.library_manager.json"
    assert encode(project)[path] == (
        b'{\n  "references": [\n    {\n      "name": "Standard",\n      "namespace": "",\n'
        b'      "version": "*"\n    }\n  ]\n}\n'
    )
    values = [{"list": "GVL_Param", "name": "cMax", "value": "2 * GVL.cLines"}]
    references = [{"name": "Tools", "parameters": values}, {"name": "Standard"}]
    project = edit.change_data(project, manager.id, {"references": references})
    files = encode(project)
    assert encode(decode(files).project) == files
    read = at(decode(files).project, f"{APP.removeprefix('Devices/')}/Library Manager").data.model_dump()
    assert list(read["references"][0]["parameters"]) == values
    assert "parameters" not in read["references"][1]


def test_the_files_of_a_project() -> None:
    project = motor()
    files = encode(project)
    assert set(files) == {
        f"{APP}/FB_Motor.st",
        f"{APP}/FB_Motor/Speed.st",
        f"{APP}/FB_Motor/Speed/Get.st",
        f"{APP}/FB_Motor/Speed/Set.st",
        f"{APP}/FB_Motor/Speed/index.json",
        f"{APP}/FB_Motor/Start.st",
        f"{APP}/FB_Motor/index.json",
        f"{APP}/Library Manager.library_manager.json",
        f"{APP}/PLC_PRG.st",
        f"{APP}/Task Configuration/MainTask.task.json",
        f"{APP}/Task Configuration/index.json",
        f"{APP}/index.json",
        "Devices/Tappet Soft PLC.device.json",
        "Devices/Tappet Soft PLC/PLC Logic/index.json",
        "Devices/Tappet Soft PLC/index.json",
        "Devices/index.json",
        "tappet-project.json",
    }
    assert list(files) == sorted(files)
    assert files[f"{APP}/FB_Motor.st"].decode() == (
        "FUNCTION_BLOCK FB_Motor\nVAR\n    rSpeed : REAL;\nEND_VAR\nStart();\nEND_FUNCTION_BLOCK\n"
    )
    assert files[f"{APP}/PLC_PRG.st"].decode() == "PROGRAM PLC_PRG\nVAR\nEND_VAR\nEND_PROGRAM\n"
    assert files[f"{APP}/FB_Motor/Start.st"].decode() == "ACTION Start\nrSpeed := 1;\nEND_ACTION\n"
    assert files[f"{APP}/FB_Motor/Speed.st"].decode() == "PROPERTY Speed : BOOL\nEND_PROPERTY\n"
    assert files[f"{APP}/FB_Motor/Speed/Get.st"].decode() == "GET\nSpeed := TRUE;\nEND_GET\n"
    assert (
        files["tappet-project.json"].decode()
        == '{\n  "description": "line 3",\n  "format": 1,\n  "name": "Press"\n}\n'
    )
    ids = [item.id for item in project.children(at(project, f"{APP}/FB_Motor".removeprefix("Devices/")).id)]
    assert files[f"{APP}/FB_Motor/index.json"].decode() == (
        "[\n"
        f'  {{"id": "{ids[0]}", "kind": "action", "name": "Start"}},\n'
        f'  {{"id": "{ids[1]}", "kind": "property", "name": "Speed"}}\n'
        "]\n"
    )


@settings(suppress_health_check=[HealthCheck.too_slow], deadline=None)
@given(projects())
def test_nothing_is_lost_and_bytes_are_stable(project: Project) -> None:
    files = encode(project)
    read = decode(files)
    assert read.project == project
    assert read.own_files == files.keys()
    assert encode(read.project) == files
    keys = [name_key(path) for path in files]
    assert len(set(keys)) == len(keys)


@settings(suppress_health_check=[HealthCheck.too_slow], deadline=None, max_examples=25)
@given(projects(), st.data())
def test_folders_on_disk(
    tmp_path_factory: pytest.TempPathFactory, first: Project, data: st.DataObject
) -> None:
    """A folder that held one project and then another reads as the other."""
    folder = tmp_path_factory.mktemp("project")
    save(first, folder)
    (folder / "README.md").write_text("mine")
    assert load(folder) == first
    second = data.draw(projects())
    save(second, folder)
    assert load(folder) == second
    assert {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()} == {
        "README.md",
        *encode(second),
    }


def text_form(kind: str) -> IecText:
    form = kinds()[kind].folder
    assert isinstance(form, IecText)
    return form


@given(TEXTS, TEXTS, st.sampled_from(["pou", "method", "accessor"]))
def test_any_two_texts_come_apart_again(declaration: str, implementation: str, kind: str) -> None:
    declaration, implementation = (
        text.replace("\r\n", "\n").replace("\r", "\n") for text in (declaration, implementation)
    )
    parts = Parts(declaration, implementation)
    text, split = write_text(text_form(kind), "Get", parts)
    assert read_text(text_form(kind), "Get", text, split) == parts


@given(TEXTS, st.sampled_from(["pou", "method", "accessor", "action", "property", "interface", "dut", "gvl"]))
def test_any_text_file_is_read_and_then_stable(text: str, kind: str) -> None:
    text = text.replace("\r\n", "\n").replace("\r", "\n")
    parts = read_text(text_form(kind), "Set", text)
    written, split = write_text(text_form(kind), "Set", parts)
    assert read_text(text_form(kind), "Set", written, split) == parts


@pytest.mark.parametrize(
    ("kind", "text", "declaration", "implementation"),
    [
        ("pou", "PROGRAM P\nVAR\nEND_VAR\nx := 1;\nend_program", "PROGRAM P\nVAR\nEND_VAR", "x := 1;"),
        ("pou", "PROGRAM P\nVAR END_VAR x := 1; END_PROGRAM", "PROGRAM P\nVAR END_VAR", " x := 1;"),
        ("pou", "PROGRAM P\nx := 1;\n\n", "PROGRAM P", "x := 1;\n"),
        ("pou", "PROGRAM P\nEND_PROGRAM", "PROGRAM P", ""),
        ("pou", "FUNCTION F : INT\nF := 1;\nEND_FUNCTION\n\n", "FUNCTION F : INT", "F := 1;"),
        ("action", "(* why *)\nACTION Start:\nx := 1;\nEND_ACTION\n", None, "(* why *)\nx := 1;"),
        ("action", "ACTION Other x := 1; END_ACTION", None, "x := 1;"),
        ("action", "x := 1;", None, "x := 1;"),
        ("accessor", "get\nVAR\nEND_VAR\nSpeed := 1;\nEND_GET", "VAR\nEND_VAR", "Speed := 1;"),
        ("dut", "TYPE T : INT; END_TYPE", "TYPE T : INT; END_TYPE", None),
        ("interface", "INTERFACE I EXTENDS J END_INTERFACE", "INTERFACE I EXTENDS J", None),
    ],
)
def test_texts_written_by_hand(
    kind: str, text: str, declaration: str | None, implementation: str | None
) -> None:
    assert read_text(text_form(kind), "Get" if kind == "accessor" else "Start", text) == Parts(
        declaration, implementation
    )


@given(st.text(min_size=1, max_size=200))
def test_file_names_are_safe_and_differ(name: str) -> None:
    stem = stem_of(name)
    assert len(stem.encode()) <= MAX_STEM_BYTES
    assert not set('<>:"/\\|?*.') & set(stem)
    assert stem.strip() == stem or name.strip() != name
    assert stem.upper() not in {"CON", "PRN", "AUX", "NUL", "COM1", "LPT9"}
    if "~" not in stem:
        assert name_of(stem) == name_of(stem_of(name_of(stem)))
    assert stem_of(name + "_") != stem


def test_a_project_written_by_hand_needs_few_files() -> None:
    files = {
        "tappet-project.json": b'{"format": 1, "name": "Hand"}',
        "POUs/Limits.st": b"VAR_GLOBAL\r\n    rMax : REAL;\r\nEND_VAR\r\n",
        "POUs/Drives/FB_Motor.st": b"\xef\xbb\xbfFUNCTION_BLOCK FB_Motor\nEND_FUNCTION_BLOCK\n",
        "POUs/Drives/FB_Motor/Start.st": b"METHOD Start : BOOL\nEND_METHOD\n",
        "POUs/notes.txt": b"mine",
        "docs/index.json": b"{}",
    }
    project = decode(files).project
    assert [(project.path_of(item.id), item.kind) for item in project.walk()] == [
        ("Drives", "folder"),
        ("Drives/FB_Motor", "pou"),
        ("Drives/FB_Motor/Start", "method"),
        ("Limits", "gvl"),
    ]
    assert project.extra_files == {"POUs/notes.txt": b"mine", "docs/index.json": b"{}"}
    assert at(project, "Limits").data.model_dump() == {"declaration": "VAR_GLOBAL\n    rMax : REAL;\nEND_VAR"}
    assert at(project, "Limits").id == derived_id("POUs/Limits")
    assert b'"id"' not in encode(project)["POUs/index.json"]
    assert decode(encode(project)).project == project


def test_new_files_join_an_indexed_folder() -> None:
    files = encode(motor())
    files[f"{APP}/E_Mode.st"] = b"TYPE E_Mode : (Off, On); END_TYPE\n"
    files[f"{APP}/Keep.st"] = b"VAR_GLOBAL PERSISTENT RETAIN\nEND_VAR\n"
    files[f"{APP}/FB_Motor/Stop.st"] = b"METHOD Stop\nEND_METHOD\n"
    files[f"{APP}/Task Configuration/Slow.task.json"] = b'{"priority": 9}'
    project = decode(files).project
    application = at(project, APP.removeprefix("Devices/"))
    assert [item.name for item in project.children(application.id)][-2:] == ["E_Mode", "Keep"]
    assert at(project, f"{APP}/Keep".removeprefix("Devices/")).kind == "persistent"
    assert at(project, f"{APP}/FB_Motor/Stop".removeprefix("Devices/")).kind == "method"
    assert at(project, f"{APP}/Task Configuration/Slow".removeprefix("Devices/")).kind == "task"


def test_what_a_missing_plug_in_wrote_is_kept() -> None:
    project = motor()
    files = encode(project)
    index = files["Devices/index.json"].replace(
        b"\n]", b',\n  {"id": "' + b"0" * 32 + b'", "kind": "cam_table", "name": "C"}\n]'
    )
    files |= {
        "POUs/index.json": b'[\n  {"kind": "cam_table", "name": "Curve"}\n]\n',
        "POUs/Curve.csv": b"1;2\n",
    }
    files["POUs/Curve.cam_table.json"] = b'{\n  "points": [\n    1.5,\n    2\n  ]\n}\n'
    read = decode(files).project
    assert encode(read) == dict(sorted(files.items()))
    with pytest.raises(FolderFormatError, match="devices alone belong in Devices"):
        decode({**files, "Devices/index.json": index})


@pytest.mark.parametrize(
    ("path", "content", "message"),
    [
        ("tappet-project.json", None, "tappet-project.json: is missing"),
        ("tappet-project.json", b"{", "tappet-project.json: line 1: Expecting"),
        ("tappet-project.json", b'{"format": 2, "name": "x", "new": 1}', "format 2, made by a newer version"),
        ("tappet-project.json", b'{"format": "1", "name": "x"}', "format: Input should be a valid integer"),
        ("tappet-project.json", b'{"format": 1, "name": "x", "colour": 1}', "colour: Extra inputs"),
        ("tappet-project.json", b"[]", "valid dictionary"),
        ("tappet-project.json", b'{"format": 1, "format": 1, "name": "x"}', "the key 'format' stands twice"),
        (f"{APP}/FB_Motor.st", None, r"FB_Motor\.st: is missing, but the index lists 'FB_Motor'"),
        (f"{APP}/FB_Motor.st", b"a\nb\xff", r"FB_Motor\.st: line 2 is not UTF-8"),
        (f"{APP}/FB_Motor.st", b"a\n\x00", r"FB_Motor\.st: pou 'FB_Motor': .*line 2 .*U\+0000"),
        (f"{APP}/Odd.st", b"x := 1;", r"Odd\.st: what it declares is not recognised"),
        (f"{APP}/A~1.st", b"PROGRAM A", "an object's file is named A, not A~1"),
        (f"{APP}/index.json", b'[{"kind": "pou"}]', r"index\.json: 0\.name: Field required"),
        (
            f"{APP}/index.json",
            b'[{"kind": "pou", "name": "A"}, {"kind": "gvl", "name": "a"}]',
            "lists 'a' twice",
        ),
        (f"{APP}/index.json", b'[{"kind": "gvl", "name": "a/../../b"}]', "is missing"),
        (f"{APP}/index.json", b'[{"kind": "pou", "name": "PLC_PRG", "split": -1}]', "split"),
        (
            f"{APP}/index.json",
            b'[{"kind": "pou", "name": "PLC_PRG", "options": {"language": "no name"}}]',
            "language",
        ),
        (f"{APP}/index.json", b'{"x": NaN}', "NaN is no JSON number"),
        (f"{APP}/index.json", b"[" * 100_000, r"index\.json: "),
        (f"{APP}/Task Configuration/MainTask.task.json", None, "is missing"),
        (
            f"{APP}/Task Configuration/MainTask.task.json",
            b'{"priority": 99}',
            r"MainTask\.task\.json: task 'MainTask': priority",
        ),
        (f"{APP}/Task Configuration/MainTask.task.json", b"[]", "should hold a JSON object"),
        (f"{APP}/Task Configuration/PLC_X.st", b"PROGRAM P", "cannot be below the task configuration"),
        ("POUs/index.json", b'[{"kind": "folder", "name": "A", "id": "x"}]', "0.id"),
        ("Devices/Loose/A.st", b"PROGRAM A", "devices alone belong in Devices"),
    ],
)
def test_broken_folders_are_refused_naming_the_file(path: str, content: bytes | None, message: str) -> None:
    files: dict[str, bytes | None] = {**encode(motor()), path: content}
    with pytest.raises(FolderFormatError, match=message):
        decode({name: value for name, value in files.items() if value is not None})


def test_one_id_for_two_objects_is_refused() -> None:
    files = encode(motor())
    same = files[f"{APP}/index.json"].split(b'"')[3]
    files["POUs/index.json"] = b'[{"kind": "folder", "name": "A", "id": "' + same + b'"}]'
    with pytest.raises(FolderFormatError, match="has the id of another object"):
        decode(files)


@settings(suppress_health_check=[HealthCheck.too_slow], deadline=None)
@given(st.data())
def test_damaged_folders_end_in_a_message(data: st.DataObject) -> None:
    files = encode(motor())
    for _ in range(data.draw(st.integers(1, 4))):
        path = data.draw(st.sampled_from(sorted(files)))
        content = bytearray(files.pop(path))
        match data.draw(st.sampled_from(["drop", "rename", "flip", "cut", "noise"])):
            case "drop":
                continue
            case "rename":
                path = data.draw(st.text(max_size=20)) + path
            case "flip" if content:
                content[data.draw(st.integers(0, len(content) - 1))] ^= data.draw(st.integers(1, 255))
            case "cut":
                del content[data.draw(st.integers(0, len(content))) :]
            case _:
                content = bytearray(data.draw(st.binary(max_size=30)))
        files[path] = bytes(content)
    try:
        project = decode(files).project
    except FolderFormatError:
        return
    assert decode(encode(project)).project == project


def test_saving_touches_only_what_differs(tmp_path: Path) -> None:
    project = motor()
    save(project, tmp_path)
    (tmp_path / ".git").mkdir()
    (tmp_path / ".git" / "x.st").write_text("PROGRAM x")
    (tmp_path / "Devices" / "drawing.png").write_bytes(b"\x89PNG")
    stamps = {path: path.stat().st_mtime_ns for path in tmp_path.rglob("*.*") if path.is_file()}
    inodes = {path: path.stat().st_ino for path in stamps}
    main = at(project, f"{APP}/PLC_PRG".removeprefix("Devices/"))
    project = edit.change_data(project, main.id, {"declaration": "PROGRAM PLC_PRG", "implementation": "x();"})
    save(project, tmp_path)
    touched = {path.name for path in stamps if path.stat().st_ino != inodes[path]}
    assert touched == {"PLC_PRG.st"}
    save(edit.delete_object(project, main.id), tmp_path)
    assert not (tmp_path / APP / "PLC_PRG.st").exists()
    assert (tmp_path / ".git" / "x.st").exists()
    assert load(tmp_path, with_extra_files=True).extra_files == {"Devices/drawing.png": b"\x89PNG"}
    assert not list(tmp_path.rglob("*.part"))


def test_a_rename_in_case_only_keeps_the_file(tmp_path: Path) -> None:
    project = motor()
    save(project, tmp_path)
    block = at(project, f"{APP}/FB_Motor".removeprefix("Devices/"))
    project = edit.rename_object(project, block.id, "fb_motor")
    save(project, tmp_path)
    assert load(tmp_path) == project
    assert not (tmp_path / APP / "FB_Motor").exists()


def test_folders_that_are_no_projects(tmp_path: Path) -> None:
    with pytest.raises(FolderFormatError, match=r"has no tappet-project\.json"):
        load(tmp_path)
    (tmp_path / "tappet-project.json").write_text('{"format": 1}')
    with pytest.raises(FolderFormatError, match=rf"{tmp_path}/tappet-project\.json: name: Field required"):
        load(tmp_path)
    with pytest.raises(FolderFormatError):
        save(motor(), tmp_path)


def test_links_are_not_followed(tmp_path: Path) -> None:
    secret = tmp_path / "secret"
    secret.mkdir()
    (secret / "Secret.st").write_text("PROGRAM Secret")
    folder = tmp_path / "project"
    save(Project("x"), folder)
    (folder / "POUs").symlink_to(secret)
    (folder / "key.txt").symlink_to(secret / "Secret.st")
    project = load(folder, with_extra_files=True)
    assert project.objects == {}
    assert project.extra_files == {}


@pytest.mark.parametrize("path", ["POUs/F.st", "pous/f.ST", "POUs", "tappet-project.json", "POUs/F.st/x"])
def test_an_extra_file_gives_way_to_an_object(path: str) -> None:
    item = make_object(id=new_id(), kind="pou", name="F", data={"declaration": "PROGRAM F"})
    files = encode(Project("x", objects={item.id: item}, extra_files={path: b"old", "a.txt": b"a"}))
    assert sorted(files) == ["POUs/F.st", "POUs/index.json", "a.txt", "tappet-project.json"]


def test_very_deep_trees() -> None:
    objects = {}
    parent: ProjectObject | None = None
    for depth in range(1500):
        parent = make_object(
            id=new_id(), parent_id=parent.id if parent else None, kind="folder", name=f"F{depth % 7}", data={}
        )
        objects[parent.id] = parent
    project = Project("deep", objects=objects)
    assert decode(encode(project)).project == project
