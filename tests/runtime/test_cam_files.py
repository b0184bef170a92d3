"""SMC_WriteCAM and SMC_ReadCAM: a cam comes back as it was, and damaged files are refused by their error."""

from __future__ import annotations

import math
import random
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path

import pytest
from library_programs import compiled

from tappet.codegen.package import CodePackage
from tappet.runtime.local import LocalRuntime

POINTS = 600
PROGRAM = f"""PROGRAM PLC_PRG
VAR
    aPoints   : ARRAY[0..{POINTS - 1}] OF SMC_CAMXYVA;
    aElements : ARRAY[0..9] OF SMC_CAMElement;
    aTappets  : ARRAY[0..9] OF SMC_CAMTappet;
    Cam       : MC_CAM_REF := (byType := 3, pce := ADR(aPoints), pt := ADR(aTappets));
    fbWrite   : SMC_WriteCAM;
    fbRead    : SMC_ReadCAM;
    nFill     : INT;
    n         : INT;
    pPoints   : POINTER TO SMC_CAMXYVA;
    pElements : POINTER TO SMC_CAMElement;
    pTappets  : POINTER TO SMC_CAMTappet;
    stPoint   : SMC_CAMXYVA;
    stElement : SMC_CAMElement;
    stTappet  : SMC_CAMTappet;
    nShown    : INT;
    xSame     : BOOL;
END_VAR
IF nFill > 0 THEN
    FOR n := 0 TO nFill - 1 DO
        aPoints[n].dX := n + SIN(n) / 3;
        aPoints[n].dY := EXP(SIN(n * 7)) / 3 * EXPT(10, n MOD 40 - 20);
        aPoints[n].dV := -1.0 / (n + 3);
        aPoints[n].dA := SIN(n * n);
    END_FOR
    Cam.nElements := nFill;
    Cam.xStart := aPoints[0].dX;
    Cam.xEnd := aPoints[nFill - 1].dX;
    nFill := 0;
END_IF
fbWrite(CAM := Cam);
fbRead();
IF fbRead.bDone THEN
    IF fbRead.CAM.byType = 3 THEN
        pPoints := fbRead.CAM.pce;
        stPoint := pPoints[nShown];
        xSame := TRUE;
        FOR n := 0 TO fbRead.CAM.nElements - 1 DO
            xSame := xSame AND pPoints[n].dX = aPoints[n].dX AND pPoints[n].dY = aPoints[n].dY
                AND pPoints[n].dV = aPoints[n].dV AND pPoints[n].dA = aPoints[n].dA;
        END_FOR
    ELSE
        pElements := fbRead.CAM.pce;
        stElement := pElements[nShown];
    END_IF
    IF nShown < fbRead.CAM.nTappets THEN
        pTappets := fbRead.CAM.pt;
        stTappet := pTappets[nShown];
    END_IF
END_IF
END_PROGRAM
"""
GOOD = """CAM 1
TYPE 3
RANGE 0 360
NAME Feeder
ELEMENTS 3
0 0 0 0
180 1.5e2 +1 -.5
360 360 0 0
TAPPETS 2
1 90 0 0 0 0
2 270.5 1 3 1000 2000000
END
"""


@cache
def _package() -> CodePackage:
    return compiled(PROGRAM, "SM3_Basic")


class Files:
    """The program, with the files of its runtime."""

    def __init__(self, runtime: LocalRuntime, folder: Path) -> None:
        self.runtime = runtime
        self.folder = folder / "files"

    def put(self, name: str, content: str | bytes) -> None:
        self.folder.mkdir(exist_ok=True)
        data = content.encode("latin-1") if isinstance(content, str) else content
        (self.folder / name).write_bytes(data)

    def text(self, name: str) -> str:
        return (self.folder / name).read_text("latin-1")

    def run(self, block: str, name: str) -> str:
        """Runs a block to its end; its error."""
        self.runtime.write_all({f"PLC_PRG.{block}.sFileName": name, f"PLC_PRG.{block}.bExecute": False})
        self.runtime.run(cycles=1)
        self.runtime.write(f"PLC_PRG.{block}.bExecute", True)
        self.runtime.run(cycles=2)
        for _ in range(500):
            said = [self.runtime.read(f"PLC_PRG.{block}.{name}") for name in ("bBusy", "bDone", "bError")]
            assert said.count(True) == 1
            if not said[0]:
                break
            self.runtime.run(cycles=2)
        error = self.literal(f"{block}.ErrorID")
        assert said == [False, error == "SMC_NO_ERROR", error != "SMC_NO_ERROR"]
        self.runtime.write(f"PLC_PRG.{block}.bExecute", False)
        self.runtime.run(cycles=1)
        assert not self.runtime.read(f"PLC_PRG.{block}.bDone")
        return error

    def read(self, content: str | bytes) -> str:
        self.put("x.cam", content)
        return self.run("fbRead", "x.cam")

    def write(self, name: str, value: float | str) -> None:
        self.runtime.write(f"PLC_PRG.{name}", value)
        self.runtime.run(cycles=1)

    def literal(self, name: str) -> str:
        return self.runtime.literal(f"PLC_PRG.{name}")


@contextmanager
def files(folder: Path) -> Iterator[Files]:
    with LocalRuntime(_package(), folder=folder) as runtime:
        yield Files(runtime, folder)


@pytest.fixture(scope="module")
def shared(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Files]:
    with files(tmp_path_factory.mktemp("cams")) as found:
        yield found


def test_a_written_cam_comes_back_to_the_last_bit(shared: Files) -> None:
    """Spec motion_semantics CAM-14, ax3000 CAM-21; a long cam takes several calls."""
    shared.write("nFill", 500)
    shared.write("Cam.strCAMName", "Long cam")
    assert shared.run("fbWrite", "long.cam") == "SMC_NO_ERROR"
    assert shared.text("long.cam").splitlines()[:2] == ["CAM 1", "TYPE 3"]
    assert shared.text("long.cam").endswith("END\n")
    assert shared.run("fbRead", "long.cam") == "SMC_NO_ERROR"
    assert shared.literal("xSame") == "TRUE"
    assert shared.literal("fbRead.CAM.nElements") == "500"
    assert shared.literal("fbRead.CAM.strCAMName") == "'Long cam'"
    assert shared.literal("fbRead.CAM.xEnd") == shared.literal("Cam.xEnd")


def test_a_cam_by_hand_has_its_points_and_tappets(shared: Files) -> None:
    assert shared.read(GOOD) == "SMC_NO_ERROR"
    shared.write("nShown", 1)
    assert shared.literal("fbRead.CAM.strCAMName") == "'Feeder'"
    shared.runtime.write_all({"PLC_PRG.fbRead.bExecute": True})
    shared.runtime.run(cycles=30)
    assert shared.literal("stPoint") == "(dX := 180.0, dY := 150.0, dV := 1.0, dA := -0.5)"
    assert shared.literal("stTappet") == (
        "(ctt := TAPPET_all, cta := TAPPETACTION_time, dwDelay := 1000, dwDuration := 2000000, iGroupID := 2,"
        " x := 270.5, dwActive := 4294967295)"
    )
    shared.write("fbRead.bExecute", False)
    assert shared.read(GOOD.replace("\n", "\r\n")) == "SMC_NO_ERROR"
    assert shared.read(GOOD.rstrip("\n")) == "SMC_NO_ERROR"


def test_polynomials_are_written_too(tmp_path: Path) -> None:
    with files(tmp_path) as found:
        polynomials = GOOD.replace("TYPE 3", "TYPE 0").replace("ELEMENTS 3", "ELEMENTS 1")
        polynomials = polynomials.replace("0 0 0 0\n180 1.5e2 +1 -.5\n360 360 0 0\n", "0 1 2 3 4 5 6\n")
        found.put("x.cam", polynomials)
        found.write("nShown", 0)
        found.runtime.write_all({"PLC_PRG.fbRead.sFileName": "x.cam", "PLC_PRG.fbRead.bExecute": True})
        found.runtime.run(cycles=40)
        assert found.literal("fbRead.ErrorID") == "SMC_NO_ERROR"
        assert found.literal("stElement") == "(dX := 0.0, aC := [1.0, 2.0, 3.0, 4.0, 5.0, 6.0])"


DAMAGED = [
    ("", "SMC_RCAM_UNEXPECTED_EOF"),
    ("CAM 1\n", "SMC_RCAM_UNEXPECTED_EOF"),
    (GOOD.replace("END\n", ""), "SMC_RCAM_UNEXPECTED_EOF"),
    (GOOD.replace("360 360 0 0\n", ""), "SMC_RCAM_WRONG_VERSION"),
    ("CAM 2\n" + GOOD.partition("\n")[2], "SMC_RCAM_WRONG_VERSION"),
    ("<?xml version='1.0'?>\n", "SMC_RCAM_WRONG_VERSION"),
    (b"\x00\x01\x02\xff" * 100, "SMC_RCAM_WRONG_VERSION"),
    ("CAM 1" + " " * 300 + "\n", "SMC_RCAM_WRONG_VERSION"),
    (GOOD.replace("1.5e2", "1.5x2"), "SMC_RCAM_WRONG_VERSION"),
    (GOOD.replace("1.5e2", "nan"), "SMC_RCAM_WRONG_VERSION"),
    (GOOD.replace("1.5e2", "1e999"), "SMC_RCAM_WRONG_VERSION"),
    (GOOD.replace("1.5e2", ""), "SMC_RCAM_WRONG_VERSION"),
    (GOOD.replace("ELEMENTS 3", "ELEMENTS -1"), "SMC_RCAM_WRONG_VERSION"),
    (GOOD.replace("ELEMENTS 3", "ELEMENTS 501"), "SMC_RCAM_TOO_MUCH_DATA"),
    (GOOD.replace("ELEMENTS 3", "ELEMENTS 1e200"), "SMC_RCAM_TOO_MUCH_DATA"),
    (GOOD.replace("TAPPETS 2", "TAPPETS 501"), "SMC_RCAM_TOO_MUCH_DATA"),
    (GOOD.replace("TYPE 3", "TYPE 1"), "SMC_RCAM_WRONG_COMPILE_TYPE"),
    (GOOD.replace("TYPE 3", "TYPE 2"), "SMC_RCAM_WRONG_COMPILE_TYPE"),
    (GOOD.replace("TYPE 3", "TYPE -1"), "SMC_RCAM_WRONG_COMPILE_TYPE"),
    (GOOD.replace("180 1.5e2", "-180 1.5e2"), "SMC_NO_CAM_REF_TYPE"),
    (GOOD.replace("RANGE 0 360", "RANGE 360 0"), "SMC_NO_CAM_REF_TYPE"),
    (GOOD.replace("2 270.5 1 3", "2 270.5 1 4"), "SMC_RCAM_WRONG_VERSION"),
]


@pytest.mark.parametrize(("content", "error"), DAMAGED)
def test_damaged_files_have_their_error(shared: Files, content: str | bytes, error: str) -> None:
    """Spec motion_semantics CAM-14: 2200 to 2204, and 750 for a cam that is none."""
    assert shared.read(GOOD) == "SMC_NO_ERROR"
    before = shared.literal("fbRead.CAM.strCAMName")
    assert shared.read(content) == error
    assert shared.literal("fbRead.CAM.strCAMName") == before


def test_files_that_cannot_be_opened(shared: Files) -> None:
    shared.write("nFill", 10)
    assert shared.run("fbRead", "nowhere.cam") == "SMC_RCAM_FILE_DOESNT_EXIST"
    assert shared.run("fbWrite", "nowhere/x.cam") == "SMC_RCAM_FILE_DOESNT_EXIST"
    assert shared.run("fbRead", "../../etc/passwd") == "SMC_RCAM_FILE_DOESNT_EXIST"


def test_tables_are_not_written(tmp_path: Path) -> None:
    """Spec ax3000 CAM-21."""
    with files(tmp_path) as found:
        found.write("nFill", 10)
        found.runtime.write_all({"PLC_PRG.Cam.byType": 2, "PLC_PRG.Cam.byVarType": 6})
        assert found.run("fbWrite", "x.cam") == "SMC_RCAM_WRONG_COMPILE_TYPE"
        found.write("Cam.wCamStructID", 0)
        assert found.run("fbWrite", "x.cam") == "SMC_NO_CAM_REF_TYPE"
        assert not (found.folder / "x.cam").exists()


@pytest.mark.parametrize("seed", range(12))
def test_random_damage_never_gives_a_cam_that_no_block_would_take(shared: Files, seed: int) -> None:
    """Characters changed, lines lost, doubled or cut: an error, or rising points and finite numbers."""
    source = random.Random(seed)
    known = {
        *("SMC_NO_ERROR", "SMC_RCAM_TOO_MUCH_DATA", "SMC_RCAM_WRONG_COMPILE_TYPE", "SMC_RCAM_WRONG_VERSION"),
        *("SMC_RCAM_UNEXPECTED_EOF", "SMC_NO_CAM_REF_TYPE"),
    }
    for _ in range(15):
        data = bytearray(GOOD.encode())
        for _ in range(source.randint(1, 4)):
            at = source.randrange(len(data))
            what = source.randrange(4)
            if what == 0:
                data[at] = source.randrange(256)
            elif what == 1:
                del data[at : at + source.randint(1, 40)]
            elif what == 2:
                data[at:at] = data[source.randrange(len(data)) :][: source.randint(1, 40)]
            else:
                data[at:at] = source.choice([b"\n", b" ", b"-", b"e", b"9" * 40, b"\0"])
            if not data:
                data = bytearray(b"\n")
        error = shared.read(bytes(data))
        assert error in known
        if error == "SMC_NO_ERROR":
            count = int(shared.literal("fbRead.CAM.nElements"))
            assert 2 <= count <= 500
            numbers = []
            for n in range(min(count, 5)):
                shared.runtime.write_all({"PLC_PRG.nShown": n, "PLC_PRG.fbRead.bExecute": True})
                shared.runtime.run(cycles=40)
                numbers.append(float(shared.literal("stPoint.dX")))
                shared.runtime.write_all({"PLC_PRG.nShown": 0, "PLC_PRG.fbRead.bExecute": False})
                shared.runtime.run(cycles=2)
            assert all(math.isfinite(number) for number in numbers)
            assert numbers == sorted(numbers)
