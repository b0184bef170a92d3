"""TwinCAT files: enumerations with texts, and elements that say nothing about the program."""

from __future__ import annotations

from tappet.project.exchange.importing import import_files

ENUM = b"""<?xml version="1.0" encoding="utf-8"?>
<TcPlcObject Version="1.1.0.1">
  <EnumerationTextList Name="E_State" Id="{3b9a4c7e-0000-4000-8000-000000000001}">
    <Declaration><![CDATA[TYPE E_State :
(
    Idle := 0,
    Busy := 1
);
END_TYPE]]></Declaration>
    <XmlArchive><Data><o xml:space="preserve" t="TextListEnumerationTextListObject" /></Data></XmlArchive>
  </EnumerationTextList>
</TcPlcObject>"""


def block(name: str, line_ids: str) -> bytes:
    return (
        f'<TcPlcObject><POU Name="{name}"><Declaration><![CDATA[FUNCTION_BLOCK {name}]]></Declaration>'
        f"<Implementation><ST><![CDATA[;]]></ST></Implementation>{line_ids}"
        f'<Method Name="Go"><Declaration><![CDATA[METHOD Go : BOOL]]></Declaration><Implementation><ST>'
        "<![CDATA[Go := TRUE;]]></ST></Implementation></Method></POU></TcPlcObject>"
    ).encode()


def test_an_enumeration_with_a_text_list_is_an_enumeration() -> None:
    done = import_files({"E_State.TcTLEO": ENUM})
    (state,) = done.project.find_kind("dut")
    assert state.name == "E_State"
    assert state.subkind == "enum"
    (note,) = [entry for entry in done.report.entries if entry.outcome == "changed"]
    assert "texts" in note.text
    assert note.line == 10


def test_line_ids_change_nothing() -> None:
    ids = '<LineIds Name="FB">text<LineId Id="3" Count="0"><LineIds /></LineId>more</LineIds>'
    with_ids, without = (import_files({"FB.TcPOU": block("FB", text)}).project for text in (ids, ""))
    for name in ("FB", "Go"):
        one, other = (
            next(item for item in project.walk() if item.name == name) for project in (with_ids, without)
        )
        assert one.data == other.data


def test_thousands_of_objects_in_one_folder_keep_their_order_and_names() -> None:
    """The files of a large project lie in one folder."""
    files = {f"FB_{number:04}.TcPOU": block(f"FB_{number % 900:04}", "") for number in range(1000)}
    project = import_files(files).project
    pous = project.find_kind("pou")
    assert len(pous) == 1000
    assert len({item.name for item in pous}) == 1000
    application = project.applications()[0]
    assert [item.index for item in project.children(application.id)] == list(
        range(len(project.children(application.id)))
    )
