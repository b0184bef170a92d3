"""Programs that refer to libraries by the names of their makers, and the pins that their manuals list."""

import pytest
from linked_application import loaded

from tappet.codegen.build import BuildOptions, LibraryReference, build_application
from tappet.lang.source import Source
from tappet.libraries import load
from tappet.libraries.catalog import Item, items

TC2_UTILITIES = "Tc2_Utilities, * (Beckhoff Automation GmbH)"
BECKHOFF = (
    "Tc2_Standard, * (Beckhoff Automation GmbH)",
    "Tc2_System, * (Beckhoff Automation GmbH)",
    TC2_UTILITIES,
)
TC2_UTILITIES_PROGRAM = """
PROGRAM MAIN
VAR
    fbFormat : FB_FormatString;
    iX       : DINT := 41;
    fTemp    : LREAL := 21.456;
    sName    : STRING(20) := 'Oven 1';
    sOut     : T_MaxString;
    stTime   : Tc2_Utilities.TIMESTRUCT;
    sTime    : STRING(24);
    fbDelay  : Tc2_Standard.TON;
END_VAR
fbDelay(IN := TRUE, PT := T#1S);
fbFormat(sFormat := '%s: %.1f C, order %d', arg1 := F_STRING(sName),
         arg2 := F_LREAL(fTemp), arg3 := F_DINT(iX));
IF NOT fbFormat.bError THEN
    sOut := fbFormat.sOut;
END_IF
stTime := DT_TO_SYSTEMTIME(DT#2026-11-22-14:05:09);
sTime := SYSTEMTIME_TO_STRING(stTime);
END_PROGRAM
"""
TC3_JSONXML = "Tc3_JsonXml, * (Beckhoff Automation GmbH)"
TC3_JSONXML_PROGRAM = """
PROGRAM MAIN
VAR
    fbWriter : FB_JsonSaxWriter;
    fbParser : Tc3_JsonXml.FB_JsonDomParser;
    jsonDoc  : SJsonValue;
    jsonProp : SJsonValue;
    sDoc     : STRING(255);
    bHasOven : BOOL;
    nOrder   : DINT;
END_VAR
fbWriter.StartObject();
fbWriter.AddKey('order');
fbWriter.AddDint(42);
fbWriter.EndObject();
sDoc := fbWriter.GetDocument();
jsonDoc := fbParser.ParseDocument(sDoc);
bHasOven := fbParser.HasMember(jsonDoc, 'oven');
jsonProp := fbParser.FindMember(jsonDoc, 'order');
IF jsonProp <> 0 THEN
    nOrder := fbParser.GetInt(jsonProp);
END_IF
END_PROGRAM
"""
TC3_EVENTLOGGER = "Tc3_EventLogger, * (Beckhoff Automation GmbH)"
TC3_EVENTLOGGER_PROGRAM = """
PROGRAM MAIN
VAR
    fbAlarm : FB_TcAlarm;
    stEvent : TcEventEntry;
    bInit   : BOOL := TRUE;
    bRaised : BOOL;
    eState  : Tc3_EventLogger.TcEventConfirmationState;
END_VAR
IF bInit THEN
    stEvent.nEventId := 12;
    stEvent.eSeverity := TcEventSeverity.Error;
    fbAlarm.CreateEx(stEvent, TRUE, 0);
    bInit := FALSE;
END_IF
fbAlarm.ipArguments.Clear().AddLReal(21.5);
fbAlarm.Raise(0);
bRaised := fbAlarm.bRaised;
fbAlarm.Confirm(0);
eState := fbAlarm.eConfirmationState;
END_PROGRAM
"""
PROGRAMS = {
    TC3_EVENTLOGGER: (TC3_EVENTLOGGER_PROGRAM, {"bRaised": "TRUE", "eState": "Confirmed"}),
    TC3_JSONXML: (TC3_JSONXML_PROGRAM, {"bHasOven": "FALSE", "nOrder": "42"}),
    TC2_UTILITIES: (
        TC2_UTILITIES_PROGRAM,
        {"sOut": "'Oven 1: 21.5 C, order 41'", "sTime": "'2026-11-22-14:05:09.000'"},
    ),
}
PINS = {
    TC2_UTILITIES: {
        "FB_FormatString": (
            "sFormat:T_MaxString " + " ".join(f"arg{n}:T_Arg" for n in range(1, 11)),
            "bError:BOOL nErrId:UDINT sOut:T_MaxString",
        ),
        "FB_FormatString2": (
            "pFormatString:POINTER TO STRING "
            + " ".join(f"arg{n}:T_Arg" for n in range(1, 11))
            + " pDstString:POINTER TO STRING nDstSize:UDINT",
            "bError:BOOL nErrId:UDINT",
        ),
        "FB_CSVMemBufferWriter": (
            "eCmd:E_EnumCmdType putValue:T_MaxString pValue:POINTER TO BYTE cbValue:UDINT bCRLF:BOOL "
            "pBuffer:POINTER TO BYTE cbBuffer:UDINT",
            None,
        ),
        "FB_CSVMemBufferReader": ("eCmd:E_EnumCmdType pBuffer:POINTER TO BYTE cbBuffer:UDINT", None),
        "F_CreateHashTableHnd": ("pEntries:POINTER TO T_HashTableEntry cbEntries:UDINT", None),
        "F_CreateLinkedListHnd": ("pEntries:POINTER TO T_LinkedListEntry cbEntries:UDINT", None),
    },
}


@pytest.mark.parametrize("name", PROGRAMS)
def test_a_program_that_names_the_library_of_its_maker(name: str) -> None:
    text, expected = PROGRAMS[name]
    libraries = tuple(LibraryReference(known) for known in dict.fromkeys([*BECKHOFF, name]))
    result = build_application([Source("MAIN", text)], options=BuildOptions(libraries=libraries, level=1))
    assert [str(d) for d in result.diagnostics if d.severity != "info"] == []
    assert result.package is not None
    with loaded(result.package) as application:
        application.cycle()
        assert {value: application.literal(f"MAIN.{value}") for value in expected} == expected


@pytest.mark.parametrize(("library", "name"), [(library, name) for library in PINS for name in PINS[library]])
def test_pins_are_those_of_the_manual(library: str, name: str) -> None:
    item = next(item for item in items(load(library)) if item.name == name)
    wanted_inputs, wanted_outputs = PINS[library][name]
    assert " ".join(f"{pin.name}:{pin.type}" for pin in item.inputs) == wanted_inputs
    if wanted_outputs is not None:
        assert " ".join(f"{pin.name}:{pin.type}" for pin in item.outputs) == wanted_outputs


DOCUMENTED = [
    item
    for library in (*PINS, TC3_JSONXML, TC3_EVENTLOGGER, "CAA Types", "IBaseLibrary")
    for item in items(load(library))
]


@pytest.mark.parametrize("item", DOCUMENTED, ids=lambda item: item.name)
def test_every_item_and_pin_says_what_it_is(item: Item) -> None:
    assert item.summary
    pins = (*item.inputs, *item.outputs, *item.in_out, *item.members)
    assert all(part.comment for part in (*pins, *item.values))
