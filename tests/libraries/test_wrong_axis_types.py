"""What is no axis and no cam does not compile where one is wanted."""

from __future__ import annotations

import pytest

from tappet.codegen.build import BuildOptions, BuildSession, LibraryReference, build_application
from tappet.lang.source import Source

SESSION = BuildSession()


def errors(type_name: str, call: str) -> list[str]:
    text = f"PROGRAM Main\nVAR\n    Given : {type_name};\n    Axis : SM3_Basic.AXIS_REF_VIRTUAL_SM3;\n"
    text += "    Halt : SM3_Basic.MC_Halt;\n    Select : SM3_Basic.MC_CamTableSelect;\nEND_VAR\n"
    options = BuildOptions(libraries=(LibraryReference("SM3_Basic"),), level=1)
    result = build_application(
        [Source("p", f"{text}{call};\nEND_PROGRAM\n")], options=options, session=SESSION
    )
    return [str(d) for d in result.diagnostics if d.severity == "error"]


@pytest.mark.parametrize(
    "type_name", ["LREAL", "SM3_Basic.MC_CAM_REF", "SM3_Basic.MC_Halt", "SM3_Basic.TRIGGER_REF"]
)
def test_what_is_no_axis_does_not_compile(type_name: str) -> None:
    """CAL-06: the message names the pin and both types."""
    (error,) = errors(type_name, "Halt(Axis := Given)")
    assert "'Axis'" in error
    assert "'AXIS_REF_SM3'" in error
    assert f"'{type_name.removeprefix('SM3_Basic.')}'" in error


def test_what_is_no_cam_does_not_compile() -> None:
    """CAL-06."""
    (error,) = errors("LREAL", "Select(Master := Axis, Slave := Axis, CamTable := Given)")
    assert "'CamTable'" in error
    assert "'MC_CAM_REF'" in error
    assert "'LREAL'" in error


def test_every_kind_of_axis_is_one() -> None:
    for type_name in ("SM3_Basic.AXIS_REF_SM3", "SM3_Basic.AXIS_REF_VIRTUAL_SM3"):
        assert errors(type_name, "Halt(Axis := Given)") == []
