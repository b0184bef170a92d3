"""TwinCAT system projects: the PLC projects in them, tasks of the system, data types, what is reported."""

from __future__ import annotations

from pathlib import Path

import pytest
from twincat_project import tcpou

from tappet.project.exchange.importing import import_files
from tappet.project.exchange.report import ExchangeError
from tappet.project.kinds.task import TaskData

SOLUTION = b"""
Microsoft Visual Studio Solution File, Format Version 12.00
Project("{B1E792BE-AA5F-4E3C-8C82-674BF9C0715B}") = "Plant", "Plant\\Plant.tsproj", "{1}"
EndProject
"""
SYSTEM = (Path(__file__).parent / "samples" / "plant.tsproj").read_bytes()
PRESS = b"""<TcSmItem>
<Project Name="Press" Disabled="true" PrjFilePath="..\\..\\Press\\press.plcproj"/></TcSmItem>"""


def _task(name: str, cycle_time: int, call: str) -> bytes:
    return (
        f'<TcPlcObject><Task Name="{name}"><CycleTime>{cycle_time}</CycleTime><Priority>20</Priority>'
        f"<PouCall><Name>{call}</Name></PouCall></Task></TcPlcObject>"
    ).encode()


FILES = {
    "Plant.sln": SOLUTION,
    "Plant/Plant.tsproj": SYSTEM,
    "Plant/_Config/PLC/Press.xti": PRESS,
    "Plant/_Config/IO/Device 1 (EtherCAT).xti": b"<TcSmItem/>",
    "Plant/Line/Line.plcproj": b"""<Project><ItemGroup><Compile Include="FB_Line.TcPOU"/>
<Compile Include="FastTask.TcTTO"/><Compile Include="SlowTask.TcTTO"/><Compile Include="TestTask.TcTTO"/>
</ItemGroup></Project>""",
    "Plant/Line/FB_Line.TcPOU": tcpou("FB_Line"),
    "Plant/Line/FastTask.TcTTO": _task("FastTask", 1000, "Fast"),
    "Plant/Line/SlowTask.TcTTO": _task("SlowTask", 10000, "Slow"),
    "Plant/Line/TestTask.TcTTO": _task("TestTask", 10000, "Testing"),
    "Plant/Press/Press.plcproj": b"""<Project><ItemGroup><Compile Include="E_Shared.TcDUT"/>
</ItemGroup></Project>""",
    "Plant/Press/E_Shared.TcDUT": b"""<TcPlcObject><DUT Name="E_Shared">
<Declaration><![CDATA[TYPE E_Shared : (A);
END_TYPE]]></Declaration></DUT></TcPlcObject>""",
    "Plant/Old/Old.plcproj": b"<Project/>",
    "Plant/Copy of Plant.tsproj": SYSTEM,
}


def test_a_solution_brings_its_plc_projects_with_the_tasks_of_the_system() -> None:
    done = import_files(FILES)
    project = done.project
    assert project.name == "Plant"
    assert [device.name for device in project.find_kind("device")] == ["Line", "Press"]
    tasks = {item.name: item.data for item in project.walk() if isinstance(item.data, TaskData)}
    assert {name: (task.interval, task.priority) for name, task in tasks.items()} == {
        "FastTask": ("T#62us500ns", 7),
        "SlowTask": ("10000", 20),
    }
    said = [str(entry) for entry in done.report.noteworthy()]
    assert [text for text in said if "TestTask" in text or "FastTask" in text] == [
        "Plant/Line/FastTask.TcTTO:1: changed FastTask: the settings of the system project hold: "
        "interval T#62us500ns instead of T#1000us, priority 7 instead of 20",
        "Plant/Plant.tsproj:25: refused TestTask: the task is disabled in the system project and was left "
        "out; it called Testing",
    ]
    left_out = [text for text in said if "Plant/Copy" in text or "Plant/Old" in text]
    assert left_out == [
        "Plant/Copy of Plant.tsproj: refused: no solution (.sln) lists this system project, so it was left "
        "out",
        "Plant/Old/Old.plcproj: refused: no system project (.tsproj) lists this PLC project",
    ]
    assert any("Press: the PLC project is disabled" in text for text in said)


def test_what_of_a_system_is_not_read_is_said() -> None:
    said = [str(entry).partition(": ")[2] for entry in import_files(FILES).report.entries]
    assert [text for text in said if "not read" in text] == [
        "changed ST_Shared.tWait: the initial value is not read",
        "refused PlantEvents: event classes are not read",
        "refused Motion: NC axes of the system project are not read; add the axes here: Lift",
        "refused Io: I/O devices of the system project are not read; add the devices here: "
        "Device 1 (EtherCAT)",
        "refused Line: links with 'Device 1 (EtherCAT) > Term 2 (EL2008)' are not read; map the variables to "
        "channels of a device here: GVL.aValve[1] ↔ Channel 1 > Output",
        "refused Line: links with the axis 'NC-Task 1 SAF > Axes > Lift' are not read: "
        "MAIN.lift.PlcToNc ↔ Inputs > In",
    ]


def test_data_types_of_a_system_are_declared_where_all_its_plc_projects_see_them() -> None:
    project = import_files(FILES).project
    types = {item.name: item for item in project.find_kind("dut")}
    assert sorted(types) == ["Bytes", "E_Shared", "ST_Shared"]
    assert types["E_Shared"].data.model_dump()["declaration"].startswith("TYPE E_Shared : (A);")
    assert types["Bytes"].data.model_dump()["declaration"] == "TYPE Bytes : ARRAY[0..5] OF BYTE;\nEND_TYPE"
    assert [above.name for above in project.ancestors(types["ST_Shared"].id)] == ["TwinCAT types"]
    assert types["ST_Shared"].data.model_dump()["declaration"].split("\n") == [
        "TYPE ST_Shared :",
        "STRUCT",
        "    // in per cent",
        "    {attribute 'unit' := 'the $'raw$' one'}",
        "    fLevel : REAL := 1.5;",
        "    aParts : ARRAY[1..4] OF E_Shared;",
        "    pNext : POINTER TO ST_Shared;",
        "    sName : STRING(20) := 'it$'s 5$$';",
        "    tWait : TIME;",
        "END_STRUCT",
        "END_TYPE",
    ]
    alone = {path: text for path, text in FILES.items() if "Press" not in path}
    found = {item.name: item for item in import_files(alone).project.find_kind("dut")}
    assert found["E_Shared"].data.model_dump()["declaration"].split("\n") == [
        "{attribute 'qualified_only'}",
        "TYPE E_Shared :",
        "(",
        "    Idle := 0,",
        "    Busy := 16#10",
        ") INT;",
        "END_TYPE",
    ]


@pytest.mark.parametrize(
    ("content", "text"),
    [
        (b"<Other/>", "is no system project"),
        (b"<TcSmProject", "is no sound XML"),
        (SYSTEM.replace(b"PersistentType", b"Other"), r"Line.plcproj' was not given with"),
    ],
)
def test_a_system_project_alone_says_what_is_missing(content: bytes, text: str) -> None:
    with pytest.raises(ExchangeError, match=text):
        import_files({"Plant.tsproj": content})


def test_files_that_are_no_code_are_named_for_what_they_hold() -> None:
    project = b"""<Project><ItemGroup><Compile Include="FB_Line.TcPOU"/><Compile Include="Screen.TcVIS"/>
<Compile Include="Texts.TcGTLO"/><Compile Include="Other.TcXYZ"/></ItemGroup></Project>"""
    files = {"P.plcproj": project, "FB_Line.TcPOU": tcpou("FB_Line"), "Screen.TcVIS": b"<TcPlcObject/>"}
    said = [str(entry) for entry in import_files(files).report.noteworthy()]
    assert said == [
        "P.plcproj:1: refused Screen.TcVIS: visualisations are not read",
        "P.plcproj:2: refused Texts.TcGTLO: text lists are not read",
        "P.plcproj:2: refused Other.TcXYZ: files of this kind are not read",
    ]
    for name, text in (("a.TcVIS", "visualisations"), ("a.project", "Export PLCopenXML"), ("a.lib", "2.3")):
        with pytest.raises(ExchangeError, match=text):
            import_files({name: b"CoDeSys+\0"})
