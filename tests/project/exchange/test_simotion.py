"""Units of SIMOTION are refused by name."""

import pytest

from tappet.project.exchange.importing import import_files
from tappet.project.exchange.report import ExchangeError

UNIT = b"""UNIT Press;
INTERFACE
    USEPACKAGE CAM;
    VAR_GLOBAL x : INT; END_VAR
    PROGRAM Main;
END_INTERFACE
IMPLEMENTATION
    PROGRAM Main
        x := x + 1;
    END_PROGRAM
END_IMPLEMENTATION
"""


def test_a_unit_is_refused_by_name() -> None:
    with pytest.raises(ExchangeError, match="SIMOTION"):
        import_files({"press.st": UNIT})


def test_a_unit_does_not_hinder_the_other_files() -> None:
    done = import_files({"press.st": UNIT, "main.st": b"PROGRAM PLC_PRG\nEND_PROGRAM\n"})
    assert [entry.source for entry in done.report.entries if entry.outcome == "refused"] == ["press.st"]
    assert done.project.find_kind("pou")


def test_interfaces_of_iec_texts_are_none() -> None:
    text = b"// IMPLEMENTATION END_IMPLEMENTATION\nINTERFACE Itf\nMETHOD Go\nEND_METHOD\nEND_INTERFACE\n"
    assert import_files({"itf.st": text}).project.find_kind("interface")
