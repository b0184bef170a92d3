"""Properties > Build of CODESYS: what leaves an object out, and what means something else here."""

from __future__ import annotations

import pytest
from native_export import Item, native

from tappet.project.exchange.importing import import_files
from tappet.project.exchange.report import Entry

FUNCTION = "FUNCTION F_Fast : DINT\nVAR_INPUT\n    x : DINT;\nEND_VAR\n"


def _plcopen(properties: str) -> dict[str, bytes]:
    """A function with build properties, as CODESYS V3 exports it."""
    kind = "http://www.3s-software.com/plcopenxml/buildproperties"
    return {
        "f.xml": f"""<project xmlns="http://www.plcopen.org/xml/tc6_0200"><types><dataTypes/><pous>
<pou name="F_Fast" pouType="function"><interface><returnType><DINT/></returnType></interface>
<body><ST><xhtml xmlns="http://www.w3.org/1999/xhtml">F_Fast := 1;</xhtml></ST></body>
<addData><data name="{kind}" handleUnknown="implementation"><BuildProperties>{properties}</BuildProperties>
</data></addData></pou></pous></types></project>""".encode()
    }


def _told(files: dict[str, bytes]) -> tuple[bool, list[Entry]]:
    """Whether the function is excluded from the build, and what the report says about it."""
    done = import_files(files)
    (pou,) = done.project.find_kind("pou")
    return pou.data.exclude_from_build, list(done.report.noteworthy())


def _native(**properties: str) -> dict[str, bytes]:
    items = [Item(1, 0, "pou", "F_Fast", FUNCTION, "F_Fast := 1;", properties=properties)]
    return {"f.export": native(items)}


@pytest.mark.parametrize("name", ["External", "ExternalImplementation"])
def test_an_external_implementation_needs_a_body(name: str) -> None:
    for files in (_plcopen(f"<{name}>true</{name}>"), _native(**{name: "True"})):
        excluded, (entry,) = _told(files)
        assert not excluded
        assert (entry.outcome, entry.object) == ("changed", "F_Fast")
        assert "external implementation" in entry.text
        assert "needs a body" in entry.text


def test_compiler_defines_are_reported() -> None:
    defines = "hello, test:='1'"
    for files in (
        _plcopen(f"<CompilerDefines>{defines}</CompilerDefines>"),
        _native(CompilerDefines=defines),
    ):
        _, (entry,) = _told(files)
        assert entry.outcome == "changed"
        assert f"'{defines}'" in entry.text
        assert "{define}" in entry.text


def test_properties_without_a_meaning_here_say_nothing() -> None:
    names = ("LinkAlways", "EnableSystemCall", "ExcludeFromBuild")
    for value in ("true", "false"):
        told = "".join(f"<{name}>{value}</{name}>" for name in names)
        excluded = value == "true"
        assert _told(_plcopen(f"<External>false</External><CompilerDefines/>{told}")) == (excluded, [])
        assert _told(_native(External="False", CompilerDefines="", **dict.fromkeys(names, value))) == (
            excluded,
            [],
        )
