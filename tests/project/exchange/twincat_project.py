"""A TwinCAT project of two blocks, one of them excluded from the build."""

from __future__ import annotations


def tcpou(name: str) -> bytes:
    """The file of a function block."""
    return (
        f'<TcPlcObject><POU Name="{name}"><Declaration><![CDATA[FUNCTION_BLOCK {name}]]></Declaration>'
        "<Implementation><ST><![CDATA[]]></ST></Implementation></POU></TcPlcObject>"
    ).encode()


FILES = {
    "Line.plcproj": b"""<Project><PropertyGroup><Name>Imported line</Name></PropertyGroup><ItemGroup>
<Compile Include="FB_Used.TcPOU"/>
<Compile Include="FB_Old.TcPOU"><ExcludeFromBuild>true</ExcludeFromBuild></Compile>
</ItemGroup></Project>""",
    "FB_Used.TcPOU": tcpou("FB_Used"),
    "FB_Old.TcPOU": tcpou("FB_Old"),
}
