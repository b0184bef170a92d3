"""One hand-written sample of each flavour: what comes in, where, with which text, and the report."""

from __future__ import annotations

from pathlib import Path

import pytest
from twincat_project import tcpou

from tappet.project.exchange.importing import import_files
from tappet.project.exchange.placing import Place
from tappet.project.exchange.plcopen_write import write_plcopen
from tappet.project.exchange.report import ImportReport
from tappet.project.model import Project, ProjectObject
from tappet.project.sources import application_sources, libraries

SAMPLES = Path(__file__).parent / "samples"


def files(name: str) -> dict[str, bytes]:
    top = SAMPLES / name
    if top.is_file():
        return {name: top.read_bytes()}
    return {p.relative_to(top).as_posix(): p.read_bytes() for p in top.rglob("*") if p.is_file()}


def imported(name: str) -> tuple[Project, ImportReport]:
    done = import_files(files(name))
    return done.project, done.report


def at(project: Project, path: str) -> ProjectObject:
    found = project.find(path)
    assert found is not None, [project.path_of(item.id) for item in project.walk()]
    return found


def text(project: Project, path: str, part: str = "declaration") -> str:
    value = getattr(at(project, path).data, part)
    assert isinstance(value, str)
    return value


def said(report: ImportReport) -> set[tuple[str, str]]:
    return {(entry.object, entry.outcome) for entry in report.noteworthy()}


@pytest.mark.parametrize(
    "name",
    [
        "codesys_35.xml",
        "beremiz.xml",
        "no_namespace.xml",
        "library.exp",
        "plain.st",
        "press.export",
        "twincat",
    ],
)
def test_what_came_in_goes_out_and_in_again_unchanged(name: str) -> None:
    project, _ = imported(name)
    content = write_plcopen(project)
    again = import_files({"x.xml": content}).project
    assert dict(again.objects) == dict(project.objects)
    assert write_plcopen(again) == content


def test_codesys_methods_properties_folders_tasks_and_plain_text() -> None:
    project, report = imported("codesys_35.xml")
    app = "Controller/PLC Logic/Mixing"
    assert project.name == "Mixer"
    assert text(project, "Types/E_State") == (
        "{attribute 'qualified_only'}\nTYPE E_State :\n"
        "(\n    Idle := 0,\n    Run := 1 // turning\n);\nEND_TYPE"
    )
    assert text(project, f"{app}/Blocks/FB_Base") == (
        "// Turns.\n// Never stops.\nFUNCTION_BLOCK FB_Base\nVAR\n    fSpeed : LREAL;\nEND_VAR"
    )
    assert text(project, f"{app}/Blocks/FB_Base/Faster") == (
        "METHOD PROTECTED Faster : BOOL\nVAR_INPUT\n    fBy : LREAL := 1;\nEND_VAR"
    )
    assert text(project, f"{app}/Blocks/FB_Base/Faster", "implementation").endswith("Faster := fSpeed > 10;")
    assert text(project, f"{app}/Blocks/FB_Base/Access/Speed") == "PROPERTY Speed : LREAL"
    assert text(project, f"{app}/Blocks/FB_Base/Access/Speed/Get", "implementation") == "Speed := fSpeed;"
    mixer = text(project, f"{app}/Blocks/Motors/FB_Mixer")
    assert mixer.startswith("FUNCTION_BLOCK FB_Mixer EXTENDS FB_Base IMPLEMENTS I_Motor\n")
    assert "as the engineer wrote it" in mixer
    assert text(project, f"{app}/Blocks/Motors/FB_Mixer/Count", "implementation") == "nStarts := nStarts + 1;"
    assert text(project, f"{app}/I_Motor/Stop") == "METHOD Stop : BOOL"
    assert text(project, f"{app}/GVL") == (
        "VAR_GLOBAL CONSTANT\n    nLimit : INT := 3;\nEND_VAR\n"
        "VAR_GLOBAL\n    aTable : ARRAY[0..nLimit] OF INT := [2(7), 8];\nEND_VAR"
    )
    assert "pData AT %MW4 : WORD;" in text(project, f"{app}/PLC_PRG")
    ladder = at(project, f"{app}/Ladder").data.model_dump()
    assert ladder["language"] == "LD"
    assert ladder["implementation"].startswith("<body>\n")
    assert 'formalParameter="none"' in ladder["implementation"]
    task = at(project, f"{app}/Task Configuration/MainTask").data.model_dump()
    assert (task["interval"], task["priority"], task["pous"][0]["name"]) == ("t#10ms", 31, "PLC_PRG")
    assert task["watchdog"] == {"enabled": True, "time": "T#20ms", "percent": None, "sensitivity": 2}
    assert said(report) == {("Controller", "refused"), ("MainTask", "changed"), ("Ladder", "kept")}


def test_a_graphical_body_gives_a_clear_error_when_compiled() -> None:
    project, _ = imported("codesys_35.xml")
    (application,) = project.applications()
    texts = {item.uri: item.text for item in application_sources(project, application.id)}
    assert "{error 'The body of Ladder is in LD, which cannot be compiled yet" in texts["Ladder"]
    assert "<body>" not in texts["Ladder"]


def test_libraries_of_an_export_keep_their_names_and_what_is_not_read_is_said() -> None:
    libraries = (
        '<Library Name="#Standard64" Namespace="Standard64" DefaultResolution="Standard64, * (System)" />'
        '<Library Name="Tools, 1.2.0.0 (Plant)" Namespace="TL">'
        '<Parameters><Parameter Name="DEPTH" Value="8" /><Parameter Name="WIDTH" Value="3" /></Parameters>'
        "</Library>"
    )
    source = (
        '<project xmlns="http://www.plcopen.org/xml/tc6_0200"><types><dataTypes /><pous /></types>'
        '<instances><configurations><configuration name="PLC"><resource name="Application"><addData>'
        '<data name="http://www.3s-software.com/plcopenxml/libraries" handleUnknown="implementation">'
        f"<Libraries>{libraries}</Libraries></data></addData></resource></configuration>"
        "</configurations></instances></project>"
    )
    done = import_files({"x.xml": source.encode()})
    manager = at(done.project, "PLC/PLC Logic/Application/Library Manager").data.model_dump()
    found = [(item["name"], item["namespace"], item["version"]) for item in manager["references"]]
    assert found == [("Standard", "", "*"), ("Standard64", "", "*"), ("Tools", "TL", "*")]
    notes = [entry.text for entry in done.report.entries if entry.object == "Tools"]
    assert "the file names version 1.2.0.0; any version that is installed is taken" in notes
    assert parameters(done.project) == [("Tools", "", "DEPTH", "8"), ("Tools", "", "WIDTH", "3")]


def test_beremiz_external_variables_il_sfc_and_instances() -> None:
    project, report = imported("beremiz.xml")
    app = "config/PLC Logic/resource1"
    assert text(project, f"{app}/Percent") == "TYPE Percent : INT (0..100) := 50;\nEND_TYPE"
    heat = text(project, f"{app}/heat")
    assert "VAR_EXTERNAL\n    level : INT;\nEND_VAR" in heat
    assert "place : Point := (x := 2.5);" in heat
    assert "    // shows\n    // the level\n    lamp AT %QX0.0 : BOOL;" in heat
    assert "level < 10" in text(project, f"{app}/heat", "implementation")
    assert text(project, f"{app}/ramp").startswith("FUNCTION ramp : REAL\n")
    assert at(project, f"{app}/old").data.model_dump()["language"] == "IL"
    assert at(project, f"{app}/steps").data.model_dump()["language"] == "SFC"
    assert at(project, f"{app}/steps/t1").data.model_dump()["implementation"] == ":= go;"
    assert text(project, f"{app}/Global_Variables") == "VAR_GLOBAL\n    level : INT := 3;\nEND_VAR"
    task = at(project, f"{app}/Task Configuration/task0").data.model_dump()
    assert (task["interval"], task["priority"], task["pous"][0]["name"]) == ("T#20ms", 0, "heat")
    assert at(project, f"{app}/Task Configuration/idle").data.model_dump()["type"] == "freewheeling"
    assert said(report) == {("steps", "kept"), ("steps.t1", "kept"), ("idle", "changed")}


def test_plcopen_without_the_namespace() -> None:
    project, report = imported("no_namespace.xml")
    assert text(project, "Tappet Soft PLC/PLC Logic/Application/Main", "implementation") == (
        "n := n + 1;\nn := n * 2;"
    )
    assert said(report) == set()


def test_codesys_23_export() -> None:
    project, report = imported("library.exp")
    app = "Tappet Soft PLC/PLC Logic/Application"
    assert text(project, f"{app}/Math/Trigonometry/TURN").endswith("(* as the name says *) *)")
    assert text(project, f"{app}/Math/Trigonometry/TURN", "implementation") == (
        "TURN := ANGLE + 180.0; (* degrees: \u00b0 *)"
    )
    assert text(project, f"{app}/Blocks/STORE").startswith("FUNCTIONBLOCK STORE\n")
    assert text(project, f"{app}/Blocks/STORE", "implementation").startswith("(* walks ( * bytes *)\nNEXT")
    assert text(project, f"{app}/Blocks/STORE/CLEAR", "implementation") == "I := 0;"
    assert text(project, f"{app}/LIMITS").startswith("TYPE LIMITS :")
    assert "NAME_LENGTH" in text(project, f"{app}/Global_Constants")
    assert "NOON" in text(project, f"{app}/Globals")
    networks = at(project, f"{app}/NETWORKS").data.model_dump()
    assert networks["language"] == "FBD"
    assert networks["implementation"].startswith("_FBD_BODY")
    assert said(report) == {
        ("", "changed"),
        ("PLC_CONFIGURATION", "refused"),
        ("NETWORKS", "kept"),
        ("Global Constants", "changed"),
    }
    lines = {entry.object: entry.line for entry in report.entries}
    assert (lines["TURN"], lines["STORE.CLEAR"], lines["PLC_CONFIGURATION"]) == (7, 48, 111)


def test_codesys_23_words_that_mean_something_else_today() -> None:
    source = (
        "(* @NESTEDCOMMENTS := 'Yes' *)\nFUNCTION WHOLE : INT\nVAR_INPUT\n\tX : REAL;\nEND_VAR\n"
        "VAR\n\tSIGNS : STRING(2) := '\u20ac\u00b0';\nEND_VAR\n(* @END_DECLARATION := '0' *)\n"
        "(* TRUNC cuts, in \u20ac *)\nWHOLE := Trunc(X); SIGNS := 'TRUNC';\nEND_FUNCTION\n"
    )
    done = import_files({"whole.exp": source.encode("cp1252")})
    path = "Tappet Soft PLC/PLC Logic/Application/WHOLE"
    assert "SIGNS : STRING(2) := '$80\u00b0';" in text(done.project, path)
    assert text(done.project, path, "implementation") == (
        "(* TRUNC cuts, in \u20ac *)\nWHOLE := TRUNC_INT(X); SIGNS := 'TRUNC';"
    )
    notes = [entry.text for entry in done.report.entries if entry.object == "WHOLE"]
    assert len([note for note in notes if "TRUNC_INT" in note or "$80" in note]) == 2


def test_plain_text_with_everything() -> None:
    project, report = imported("plain.st")
    app = "Tappet Soft PLC/PLC Logic/Application"
    assert text(project, f"{app}/Mode") == (
        "(* A file with everything *)\nTYPE\n  Mode : (Off, On); // of a lamp\nEND_TYPE"
    )
    assert text(project, f"{app}/Level") == "TYPE   Level : INT (0..10);\nEND_TYPE"
    assert "MAX_COUNT" in text(project, f"{app}/plain")
    assert text(project, f"{app}/plain").startswith("{attribute 'qualified_only'}\nVAR_GLOBAL")
    assert text(project, f"{app}/I_Lamp") == "INTERFACE I_Lamp"
    assert text(project, f"{app}/FB_Lamp").startswith(
        "// A lamp.\nFUNCTION_BLOCK FB_Lamp IMPLEMENTS I_Lamp\nVAR"
    )
    assert text(project, f"{app}/FB_Lamp", "implementation") == "  Toggle();"
    assert text(project, f"{app}/FB_Lamp/Switch").startswith(
        "  // Switches it.\n  METHOD PUBLIC Switch : BOOL"
    )
    assert text(project, f"{app}/FB_Lamp/Lit/Get", "implementation") == "      Lit := _bOn;"
    assert text(project, f"{app}/FB_Lamp/Toggle", "implementation") == "    _bOn := NOT _bOn;"
    assert "bShared" in text(project, f"{app}/Config_Globals")
    task = at(project, f"{app}/Task Configuration/Fast").data.model_dump()
    assert (task["interval"], task["priority"], task["pous"][0]["name"]) == ("T#5ms", 2, "Main")
    assert said(report) == set()


def test_twincat_project() -> None:
    project, report = imported("twincat")
    app = "Tappet Soft PLC/PLC Logic/Application"
    assert (project.name, project.description) == ("Packing line", "Two belts")
    assert at(project, f"{app}/Empty").kind == "folder"
    assert "unit: m/s" in text(project, f"{app}/DUTs/ST_Belt")
    assert text(project, f"{app}/POUs/FB_Belt/Orders_External/Run", "implementation") == (
        "fNow := fSpeed;\nRun := TRUE;"
    )
    assert text(project, f"{app}/POUs/FB_Belt/Now/Get", "implementation") == "Now := fNow;"
    assert at(project, f"{app}/POUs/FB_Belt").id == "0000000000004000800000000000" + "00a6"
    main = at(project, f"{app}/POUs/MAIN").data.model_dump()
    assert main["language"] == "FBD"
    assert main["implementation"].lstrip().startswith("<Implementation")
    task = at(project, f"{app}/Task Configuration/PlcTask").data.model_dump()
    assert (task["interval"], task["priority"], task["pous"][0]["name"]) == ("2000", 20, "MAIN")
    library = at(project, f"{app}/Library Manager").data.model_dump()["references"]
    assert list(library) == [{"name": "Standard", "version": "*", "namespace": "Tc2_Standard"}]
    assert said(report) == {
        ("MAIN", "kept"),
        ("POUs/Gone.TcPOU", "refused"),
        ("VISUs/Screen.TcVIS", "refused"),
        ("Tc2_Standard", "changed"),
        ("Orders/External", "changed"),
    }


def test_into_a_project_nothing_is_overwritten() -> None:
    project, _ = imported("plain.st")
    done = import_files(files("plain.st"), project)
    app = "Tappet Soft PLC/PLC Logic/Application"
    assert (
        text(done.project, f"{app}/FB_Lamp_1").splitlines()[1] == "FUNCTION_BLOCK FB_Lamp_1 IMPLEMENTS I_Lamp"
    )
    assert at(done.project, f"{app}/FB_Lamp").id == at(project, f"{app}/FB_Lamp").id
    assert {item.id for item in project.walk()} < {item.id for item in done.project.walk()}
    assert ("FB_Lamp", "changed") in said(done.report)


def test_temporary_variables_of_functions_and_methods_become_variables() -> None:
    function = "FUNCTION F : INT\nVAR_TEMP // VAR_TEMP\n    t : INT;\nEND_VAR\n"
    block = "FUNCTION_BLOCK FB\nVAR_TEMP\n    t : INT;\nEND_VAR\n"
    method = "METHOD M : INT\nVAR_TEMP\n    t : INT;\nEND_VAR\n"
    whole = (
        f"{function}F := t;\nEND_FUNCTION\n{block}t := 1;\n{method}M := t;\nEND_METHOD\nEND_FUNCTION_BLOCK\n"
    )
    done = import_files({"all.st": whole.encode()})
    app = "Tappet Soft PLC/PLC Logic/Application"
    assert "VAR // VAR_TEMP" in text(done.project, f"{app}/F")
    assert "VAR_TEMP" in text(done.project, f"{app}/FB")
    assert "VAR_TEMP" not in text(done.project, f"{app}/FB/M")
    assert {name for name, outcome in said(done.report) if outcome == "changed"} == {"F", "M"}


def test_a_function_without_a_return_type_is_marked() -> None:
    head = "// Logs.\nFUNCTION F_Log\nVAR_INPUT\n    sText : STRING;\nEND_VAR\n"
    xml = (
        '<TcPlcObject Version="1.1.0.1"><POU Name="F_Log" Id="{0}" SpecialFunc="None">'
        f"<Declaration><![CDATA[{head}]]></Declaration><Implementation><ST><![CDATA[;]]></ST></Implementation>"
        "</POU></TcPlcObject>"
    )
    marked = head.replace("FUNCTION", "{attribute 'no_return_type'}\nFUNCTION", 1).rstrip("\n")
    for name, content in (("F_Log.TcPOU", xml), ("log.st", f"{head};\nEND_FUNCTION\n")):
        done = import_files({name: content.encode()})
        path = "Tappet Soft PLC/PLC Logic/Application/F_Log"
        assert text(done.project, path).rstrip("\n") == marked
        assert said(done.report) == {("F_Log", "changed")}
        again = import_files({"x.xml": write_plcopen(done.project)})
        assert text(again.project, path) == text(done.project, path)
    assert said(import_files({"f.st": b"FUNCTION F : INT\nF := 1;\nEND_FUNCTION\n"}).report) == set()


def test_twincat_parameters_of_libraries_and_empty_folders_of_functions() -> None:
    project_file = (
        '<Project xmlns="http://schemas.microsoft.com/developer/msbuild/2003"><ItemGroup>'
        '<Compile Include="F_Half.TcPOU" /></ItemGroup><ItemGroup>'
        '<PlaceholderReference Include="TcUnit">'
        "<DefaultResolution>TcUnit, * (www.tcunit.org)</DefaultResolution>"
        '<Namespace>TcUnit</Namespace><Parameters><Parameter ListName="GVL_PARAM_TCUNIT" xmlns="">'
        "<Key>XUNITENABLEPUBLISH</Key><Value>TRUE</Value></Parameter></Parameters></PlaceholderReference>"
        "</ItemGroup></Project>"
    )
    function = (
        '<TcPlcObject><POU Name="F_Half" Id="{0}">'
        "<Declaration><![CDATA[FUNCTION F_Half : INT]]></Declaration>"
        "<Implementation><ST><![CDATA[F_Half := 1;]]></ST></Implementation>"
        '<Folder Name="Old" Id="{1}" /></POU></TcPlcObject>'
    )
    done = import_files({"P.plcproj": project_file.encode(), "F_Half.TcPOU": function.encode()})
    assert said(done.report) == set()
    assert parameters(done.project) == [("TcUnit", "GVL_PARAM_TCUNIT", "XUNITENABLEPUBLISH", "TRUE")]
    again = import_files({"x.xml": write_plcopen(done.project)})
    assert parameters(again.project) == parameters(done.project)


@pytest.mark.parametrize(("written", "expected"), [("true", True), ("False", False), ("", False)])
def test_twincat_says_that_names_of_a_library_need_the_namespace(written: str, expected: bool) -> None:
    project_file = (
        '<Project xmlns="http://schemas.microsoft.com/developer/msbuild/2003"><ItemGroup>'
        '<PlaceholderReference Include="ZCore"><DefaultResolution>ZCore, * (Z)</DefaultResolution>'
        f"<Namespace>ZCore</Namespace><QualifiedOnly>{written}</QualifiedOnly></PlaceholderReference>"
        "</ItemGroup></Project>"
    )
    done = import_files({"P.plcproj": project_file.encode()})
    (application,) = done.project.applications()
    (reference,) = [one for one in libraries(done.project, application.id) if one.name == "ZCore"]
    assert reference.qualified_only is expected


def parameters(project: Project) -> list[tuple[str, str, str, str]]:
    """Values that the references of the only application give to parameters."""
    (application,) = project.applications()
    return [
        (reference.name, one.list, one.name, one.value)
        for reference in libraries(project, application.id)
        for one in reference.parameters
    ]


def test_parameters_of_libraries_in_a_codesys_export() -> None:
    library = (
        '<Library Name="#Util" Namespace="Util" DefaultResolution="Util, * (System)"><Parameters>'
        '<Parameter Name="IBLOCKSIZE" Value="22800" /><Parameter Name="CEMPTY" Value="" />'
        "</Parameters></Library>"
    )
    export = (
        '<project xmlns="http://www.plcopen.org/xml/tc6_0200"><types><dataTypes /><pous /></types><instances>'
        '<configurations><configuration name="Device"><resource name="Application"><addData>'
        '<data name="http://www.3s-software.com/plcopenxml/libraries" handleUnknown="implementation">'
        f"<Libraries>{library}</Libraries></data></addData></resource></configuration></configurations>"
        "</instances></project>"
    )
    done = import_files({"x.xml": export.encode()})
    assert parameters(done.project) == [("Util", "", "IBLOCKSIZE", "22800")]
    assert [entry.text for entry in done.report.noteworthy()] == [
        "the parameter 'CEMPTY' is given no value: it keeps its own"
    ]


def test_values_for_parameters_join_those_that_are_there() -> None:
    project_file = (
        "<Project><ItemGroup>"
        '<PlaceholderReference Include="TcUnit"><DefaultResolution>TcUnit, *</DefaultResolution><Parameters>'
        '<Parameter ListName="GVL_PARAM_TCUNIT"><Key>XUNITENABLEPUBLISH</Key><Value>{}</Value></Parameter>'
        '<Parameter ListName="GVL_PARAM_TCUNIT"><Key>{}</Key><Value>5</Value></Parameter>'
        "</Parameters></PlaceholderReference></ItemGroup></Project>"
    )
    first = import_files({"P.plcproj": project_file.format("TRUE", "MAXNUMBEROFTESTSUITES").encode()})
    (application,) = first.project.applications()
    second = project_file.format("FALSE", "XUNITBUFFERSIZE").encode()
    done = import_files({"P.plcproj": second}, first.project, where=Place(application.id))
    assert parameters(done.project) == [
        ("TcUnit", "GVL_PARAM_TCUNIT", "XUNITENABLEPUBLISH", "TRUE"),
        ("TcUnit", "GVL_PARAM_TCUNIT", "MAXNUMBEROFTESTSUITES", "5"),
        ("TcUnit", "GVL_PARAM_TCUNIT", "XUNITBUFFERSIZE", "5"),
    ]


def test_parameter_lists_of_twincat_are_parameter_lists() -> None:
    xml = (
        '<TcPlcObject><GVL Name="GVL_Param" Id="{0}" ParameterList="True"><Declaration>'
        "<![CDATA[{attribute 'qualified_only'}\n// Sizes\nVAR_GLOBAL CONSTANT\n  cMax : INT := 5;\nEND_VAR]]>"
        "</Declaration></GVL></TcPlcObject>"
    )
    done = import_files({"GVL_Param.TcGVL": xml.encode()})
    path = "Tappet Soft PLC/PLC Logic/Application/GVL_Param"
    assert text(done.project, path).splitlines()[:4] == [
        "{attribute 'qualified_only'}",
        "// Sizes",
        "{attribute 'parameter_list'}",
        "VAR_GLOBAL CONSTANT",
    ]
    found = done.project.find(path)
    assert found is not None
    assert found.subkind == "parameter_list"
    again = import_files({"x.xml": write_plcopen(done.project)})
    assert text(again.project, path) == text(done.project, path)


def test_what_is_in_an_excluded_folder_of_a_twincat_project_is_not_built() -> None:
    project = b"""<Project><PropertyGroup><Name>Line</Name></PropertyGroup><ItemGroup>
<Compile Include="POUs\\Tried\\More\\FB_Tried.TcPOU"/>
<Compile Include="POUs\\FB_Used.TcPOU"><ExcludeFromBuild>false</ExcludeFromBuild></Compile>
<Folder Include="POUs"/><Folder Include="POUs\\tried"><ExcludeFromBuild>true</ExcludeFromBuild></Folder>
</ItemGroup></Project>"""
    files = {
        "Line.plcproj": project,
        "POUs/Tried/More/FB_Tried.TcPOU": tcpou("FB_Tried"),
        "POUs/FB_Used.TcPOU": tcpou("FB_Used"),
    }
    done = import_files(files)
    blocks = {item.name: item.data.exclude_from_build for item in done.project.find_kind("pou")}
    assert blocks == {"FB_Tried": True, "FB_Used": False}
    assert list(done.report.noteworthy()) == []
