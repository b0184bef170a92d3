"""CODESYS exchange files (`.export`): objects with texts, tasks, libraries, places in the tree."""

from __future__ import annotations

import pytest
from native_export import Item, native, single

from tappet.project.exchange.importing import import_files
from tappet.project.exchange.report import ExchangeError
from tappet.project.model import Project

TASK = (
    single("Kindoftask", "Cyclic")
    + single("Priority", "4")
    + f'<Single Name="Interval">{single("Time", "2500")}{single("Unit", "µs")}</Single>'
    + f'<Single Name="Watchdog">{single("Enabled", "True")}'
    + f'<Single Name="Time">{single("Time", "t#9ms")}</Single>'
    + f'{single("Sensitivity", "3")}</Single><List Name="PouList"><Single>{single("Name", "PLC_PRG")}'
    + f"{single('Comment', 'first')}</Single></List>"
)
LIBRARIES = (
    '<List Name="Items"><Single>'
    + single("DefaultResolution", "Util, * (System)")
    + single("Namespace", "Util")
    + single("QualifiedOnly", "True")
    + "</Single></List>"
)
WHOLE = [
    Item(1, 0, "device", "Press"),
    Item(2, 1, "logic", "PLC Logic", path=("Press",)),
    Item(3, 2, "application", "App", path=("Press", "PLC Logic")),
    Item(4, 3, "folder", "Blocks"),
    Item(
        5,
        4,
        "pou",
        "FB_Press",
        "FUNCTION_BLOCK FB_Press\nVAR\n\tx < 3\nEND_VAR\n",
        "x := 1;\n",
        as_lines=True,
    ),
    Item(6, 5, "method", "Go", "METHOD Go : BOOL", "Go := TRUE;"),
    Item(7, 5, "property", "Force", "PROPERTY Force : REAL"),
    Item(8, 7, "accessor", "Get", "VAR\nEND_VAR", "Force := 1;"),
    Item(9, 5, "action", "Reset", body="x := 0;"),
    Item(10, 3, "tasks", "Task configuration"),
    Item(11, 10, "task", "MainTask", inner=TASK),
    Item(12, 11, "call", "PLC_PRG"),
    Item(13, 3, "libraries", "Library Manager", inner=LIBRARIES),
    Item(14, 3, "visualisation", "Screen"),
    Item(15, 1, "device", "Servo_Drive", path=("Press",)),
    Item(16, 3, "dut", "E_Mode", "TYPE E_Mode : (Idle, Busy); END_TYPE", excluded=True),
    Item(17, 3, "unknown", "Strange", "FUNCTION Helper : INT", "Helper := 1;"),
    Item(18, 0, "gvl", "GVL_Pool", "VAR_GLOBAL\nEND_VAR", path=("Shared",)),
]


def _paths(project: Project) -> dict[str, str]:
    found = {}
    for item in project.walk():
        names = [item.name, *(above.name for above in project.ancestors(item.id))]
        found["/".join(reversed(names))] = item.id
    return found


def test_a_whole_project() -> None:
    done = import_files({"Press.export": native(WHOLE)})
    paths = _paths(done.project)
    block = "Press/PLC Logic/App/Blocks/FB_Press"
    assert {path for path in paths if path.startswith(block)} == {
        block, f"{block}/Go", f"{block}/Force", f"{block}/Force/Get", f"{block}/Reset",
    }  # fmt: skip
    assert done.project.get(paths[block]).data.model_dump()["declaration"] == (
        "FUNCTION_BLOCK FB_Press\nVAR\n\tx < 3\nEND_VAR"
    )
    assert done.project.get(paths[block]).data.model_dump()["implementation"] == "x := 1;"
    assert "Shared/GVL_Pool" in paths
    assert done.project.get(paths["Press/PLC Logic/App/E_Mode"]).excluded
    task = done.project.get(paths["Press/PLC Logic/App/Task Configuration/MainTask"]).data.model_dump()
    assert (task["type"], task["interval"], task["priority"]) == ("cyclic", "T#2500us", 4)
    assert task["watchdog"] == {"enabled": True, "time": "t#9ms", "percent": None, "sensitivity": 3}
    assert task["pous"] == ({"name": "PLC_PRG", "comment": "first"},)
    manager = done.project.get(paths["Press/PLC Logic/App/Library Manager"]).data.model_dump()
    assert [one["name"] for one in manager["references"]] == ["Standard", "Util"]
    assert [one.get("qualified_only") for one in manager["references"]] == [None, True]
    refused = [entry for entry in done.report.entries if entry.outcome == "refused"]
    assert [(entry.object, entry.text) for entry in refused] == [
        ("Screen", "visualisations are not read"),
        ("Servo_Drive", "the device is not read; add it here and map its channels"),
    ]


def test_a_part_of_an_application_goes_into_the_application_of_the_project() -> None:
    path = ("Device", "PLC Logic", "Application", "Blocks")
    items = [
        Item(6, 5, "method", "Go", "METHOD Go", "", path=(*path, "FB_Press")),
        Item(5, 9, "pou", "FB_Press", "FUNCTION_BLOCK FB_Press", "", path=path),
        Item(7, 9, "pou", "F_Step", "FUNCTION F_Step\nVAR_INPUT\nEND_VAR", "", path=path),
    ]
    done = import_files({"part.xml": native(items)})
    top = "Tappet Soft PLC/PLC Logic/Application/Blocks"
    assert {f"{top}/FB_Press/Go", f"{top}/F_Step"} <= set(_paths(done.project))
    assert any("no_return_type" in entry.text for entry in done.report.entries)


def test_entries_in_lists_of_other_versions() -> None:
    found = [import_files({"one.export": native(WHOLE, tag)}) for tag in ("List2", "List")]
    assert _paths(found[0].project).keys() == _paths(found[1].project).keys()


def test_objects_of_no_application_alone() -> None:
    done = import_files({"one.export": native([Item(5, 0, "pou", "PLC_PRG", "PROGRAM PLC_PRG", "")])})
    assert "Tappet Soft PLC/PLC Logic/Application/PLC_PRG" in _paths(done.project)


def test_a_drawn_body_is_kept() -> None:
    drawn = '<Single Name="Implementation" Type="{32d3375e-c010-41e2-9e43-b2fbf4f2b374}"><List2 /></Single>'
    item = Item(5, 0, "pou", "Chart", "PROGRAM Chart", inner=drawn)
    done = import_files({"one.export": native([item])})
    chart = next(one for one in done.project.walk() if one.name == "Chart").data.model_dump()
    assert chart["language"] == "CFC"
    assert chart["implementation"].startswith('<Single Name="Implementation"')
    assert [entry.outcome for entry in done.report.entries] == ["kept"]


def test_an_accessor_of_another_name_is_refused() -> None:
    items = [
        Item(5, 0, "pou", "FB_Press", "FUNCTION_BLOCK FB_Press", ""),
        Item(7, 5, "property", "Force", "PROPERTY Force : REAL"),
        Item(8, 7, "accessor", "Fetch", "", "Force := 1;"),
    ]
    done = import_files({"one.export": native(items)})
    (entry,) = done.report.noteworthy()
    assert (entry.object, entry.outcome) == ("Fetch", "refused")
    assert "is named Get or Set, not 'Fetch'" in entry.text


@pytest.mark.parametrize(
    ("content", "text"),
    [
        (b"<ExportFile><StructuredView/></ExportFile>", "holds no objects; export them in CODESYS"),
        (b"<ExportFile>", "is no sound XML"),
        (native([Item(5, 6, "folder", "A"), Item(6, 5, "folder", "B")]), "stands below itself"),
        (native([Item(5, 0, "visualisation", "Screen")]), "Screen: visualisations are not read"),
    ],
)
def test_a_faulty_file_says_what_is_wrong(content: bytes, text: str) -> None:
    with pytest.raises(ExchangeError, match=text):
        import_files({"x.export": content})
