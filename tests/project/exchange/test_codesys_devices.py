"""CODESYS exports of whole devices: what they hold besides the standard's elements; the sample compiles."""

from __future__ import annotations

from pathlib import Path

import pytest

from tappet.lang.analysis import AnalysisOptions, analyse
from tappet.lang.parser import parse
from tappet.project.exchange.importing import Imported, import_files
from tappet.project.exchange.plcopen_write import write_plcopen
from tappet.project.model import Project
from tappet.project.sources import application_sources

SAMPLE = Path(__file__).parent / "samples" / "codesys_devices.xml"
APPLICATION = "Device/PLC Logic/Application"
DATA = "http://www.3s-software.com/plcopenxml/"


@pytest.fixture(scope="module")
def done() -> Imported:
    return import_files({"press.xml": SAMPLE.read_bytes()})


def declaration(done: Imported, path: str) -> str:
    found = done.project.find(path)
    assert found is not None, [done.project.path_of(item.id) for item in done.project.walk()]
    return str(found.data.model_dump()["declaration"])


def errors(project: Project) -> list[str]:
    (application,) = project.applications()
    units, found = [], []
    for text in application_sources(project, application.id):
        parsed = parse(text)
        found += parsed.diagnostics
        units.append(parsed.unit)
    found += analyse(units, AnalysisOptions()).diagnostics
    return [f"{item.uri}: {item.code} {item.message}" for item in found if item.code.startswith("E")]


def test_nothing_of_the_sample_is_an_error(done: Imported) -> None:
    assert errors(done.project) == []


def test_inheritance_of_structures_and_interfaces_and_unions(done: Imported) -> None:
    assert declaration(done, "ST_Sheet").startswith("TYPE ST_Sheet EXTENDS ST_Part :\nSTRUCT\n")
    assert declaration(done, "I_Counter") == "INTERFACE I_Counter EXTENDS I_Restart"
    assert declaration(done, "Types/U_Bits") == (
        "TYPE U_Bits :\nUNION\n    fValue : LREAL;\n    nValue : LINT;\nEND_UNION\nEND_TYPE"
    )


def test_what_codesys_marks_by_attributes_stands_in_the_declaration(done: Imported) -> None:
    block = declaration(done, "FB_Counter")
    assert "VAR_INPUT CONSTANT\n    nMax : UINT := 10;\nEND_VAR" in block
    program = declaration(done, f"{APPLICATION}/PLC_PRG")
    assert "    fbParts : FB_Counter(sName := 'parts, good', nFirst := 3);\n" in program
    assert "attribute" not in block + program


def test_variables_of_mapped_channels_are_declared_and_the_devices_named(done: Imported) -> None:
    assert declaration(done, f"{APPLICATION}/IoConfig_Globals_Mapping") == (
        "VAR_GLOBAL\n"
        "    DO_Lamp : BOOL; // _4DO: Outputs 0 - 3, BIT0\n"
        "    AO_Level : INT; // _4DO: Analog Output\n"
        "    DI_Start : BOOL; // _1DI: Input\n"
        "END_VAR"
    )
    notes = {entry.object: (entry.outcome, entry.text) for entry in done.report.noteworthy()}
    assert set(notes) == {"Device", "IoConfig_Globals_Mapping"}
    assert notes["Device"][0] == "refused"
    assert "(Bus, _4DO, _1DI)" in notes["Device"][1]


def test_the_sample_comes_back_from_our_own_export(done: Imported) -> None:
    content = write_plcopen(done.project)
    again = import_files({"x.xml": content}).project
    assert dict(again.objects) == dict(done.project.objects)


def test_a_controller_below_a_device_keeps_its_application() -> None:
    inner = (
        '<configuration name="Inner"><resource name="Small"><addData>'
        f'<data name="{DATA}pou"><pou name="P" pouType="program"><body><ST>;</ST></body></pou></data>'
        "</addData></resource></configuration>"
    )
    source = (
        '<project xmlns="http://www.plcopen.org/xml/tc6_0200"><types><dataTypes /><pous /></types><instances>'
        '<configurations><configuration name="Outer"><resource name="App" /><addData>'
        f'<data name="{DATA}configurations"><configurations><configuration name="Bus"><addData>'
        f'<data name="{DATA}configurations"><configurations>{inner}</configurations></data>'
        "</addData></configuration></configurations></data>"
        "</addData></configuration></configurations></instances></project>"
    )
    project = import_files({"x.xml": source.encode()}).project
    assert project.find("Inner/PLC Logic/Small/P") is not None
    assert [item.name for item in project.find_kind("application")] == ["App", "Small"]


def test_settings_of_charts_are_told_where_they_switch_something_on() -> None:
    flags = '<SFCSettings><Flags><Init Declare="true" Use="true" /></Flags></SFCSettings>'
    source = (
        '<project xmlns="http://www.plcopen.org/xml/tc6_0200"><types><dataTypes /><pous>'
        '<pou name="P" pouType="program"><body><ST>;</ST></body><addData>'
        f'<data name="{DATA}sfcsettings">{flags}</data></addData></pou></pous></types></project>'
    )
    report = import_files({"x.xml": source.encode()}).report
    assert [(entry.object, entry.outcome) for entry in report.noteworthy()] == [("P", "refused")]
