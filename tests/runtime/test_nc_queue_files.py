"""SMC_ReadNCQueue: path objects come back as they were, damaged files are refused."""

from __future__ import annotations

import random
from pathlib import Path

from file_programs import FileProgram

from tappet.cnc.queue_file import FIELDS, queue_text


def _same() -> str:
    """Statements that take the members of the first object."""
    values = (
        f"BOOL_TO_LREAL(pGeo^.{name})" if name == "b3D" else f"TO_LREAL(pGeo^.{name})" for name in FIELDS
    )
    return "\n".join(f"        afFirst[{n}] := {value};" for n, value in enumerate(values))


PROGRAM = f"""PROGRAM PLC_PRG
VAR
    rq       : SMC_ReadNCQueue;
    aBuffer  : ARRAY[1..8] OF SMC_GEOINFO;
    nBuffer  : UDINT := 8;
    nPointer : INT := 1;
    xTake    : BOOL := TRUE;
    pGeo     : POINTER TO SMC_GEOINFO;
    nTaken   : DINT;
    fSum     : LREAL;
    afFirst  : ARRAY[0..{len(FIELDS) - 1}] OF LREAL;
    iGenerator : BYTE;
    xEnd     : BOOL;
END_VAR
rq.pBuffer := 0;
IF nPointer > 0 THEN
    rq.pBuffer := ADR(aBuffer);
END_IF
rq(dwBufferSize := nBuffer * SIZEOF(SMC_GEOINFO));
WHILE xTake AND SMC_GetCount(rq.poqDataOut) > 0 DO
    pGeo := SMC_GetObj(rq.poqDataOut, 0);
    nTaken := nTaken + 1;
    fSum := fSum + nTaken * pGeo^.dLength;
    IF nTaken = 1 THEN
{_same()}
    END_IF
    SMC_DeleteObj(rq.poqDataOut, 0);
END_WHILE
iGenerator := rq.poqDataOut^.byGenerator;
xEnd := rq.poqDataOut^.bEndOfList;
END_PROGRAM
"""


class Queue(FileProgram):
    text = PROGRAM

    def run(self, text: str, name: str = "part.queue", cycles: int = 400) -> str:
        """Reads a file to its end; the error."""
        (self.folder / "part.queue").write_text(text)
        self.runtime.write("PLC_PRG.rq.bExecute", False)
        self.runtime.run(cycles=2)
        self.set(nTaken=0, fSum=0.0)
        self.runtime.write_all({"PLC_PRG.rq.bExecute": True, "PLC_PRG.rq.sFileName": name})
        self.runtime.run(cycles=2)
        for _ in range(cycles):
            if not self.runtime.read("PLC_PRG.rq.bBusy"):
                break
            self.runtime.run(cycles=3)
        return self.literal("rq.ErrorID")


def geo(seed: int) -> dict[str, float]:
    """An object with a number of its own in every member."""
    values = random.Random(seed)
    found = {name: values.uniform(-1e3, 1e3) for name in FIELDS}
    whole = ("iHelpID", "iSource", "byIntern", "pi", "b3D", "iMove")
    for name in FIELDS:
        if name.startswith(whole) and ".d" not in name:
            found[name] = float(values.randint(0, 200))
    return {**found, "b3D": 1.0, "iMoveType": 2.0, "dLength": float(seed)}


def test_objects_come_back(tmp_path: Path) -> None:
    """Spec CNCR-32: every member to the last bit; more objects than the buffer has places for."""
    objects = [geo(n) for n in range(1, 41)]
    with Queue.running(tmp_path) as program:
        assert program.run(queue_text("Part", objects)) == "SMC_NO_ERROR"
        assert program.literal("rq.bDone") == "TRUE"
        assert program.literal("rq.iObjectsRead") == program.literal("nTaken") == "40"
        assert float(program.literal("fSum")) == sum(n * n for n in range(1, 41))
        found = [float(program.literal(f"afFirst[{n}]")) for n in range(len(FIELDS))]
        assert found == [objects[0][name] for name in FIELDS]
        assert (program.literal("iGenerator"), program.literal("xEnd")) == ("255", "TRUE")
        assert program.run(queue_text("None", [])) == "SMC_NO_ERROR"


def test_waits_for_room(tmp_path: Path) -> None:
    """The block goes on when the consumer has taken objects."""
    with Queue.running(tmp_path) as program:
        program.set(xTake=False)
        program.run(queue_text("Part", [geo(n) for n in range(1, 21)]), cycles=20)
        assert (program.literal("rq.iObjectsRead"), program.literal("rq.bBusy")) == ("5", "TRUE")
        program.set(xTake=True)
        program.runtime.run(cycles=40)
        assert (program.literal("rq.iObjectsRead"), program.literal("rq.bDone")) == ("20", "TRUE")


def test_errors(tmp_path: Path) -> None:
    """Spec cnc 13: 2050 to 2053."""
    good = queue_text("Part", [geo(1), geo(2)])
    with Queue.running(tmp_path) as program:
        assert program.run(good, name="other") == "SMC_RNCQ_FILE_DOESNT_EXIST"
        lines = good.splitlines()
        for bad in (
            "",
            "QUEUE 2\n",
            "\n".join(lines[:4]),
            "\n".join(lines[:-1]),
            "\n".join([*lines[:3], lines[3] + " 1", *lines[4:]]),
            "\n".join([*lines[:3], lines[3].rsplit(" ", 1)[0], *lines[4:]]),
            "\n".join([*lines[:3], lines[3].replace("2 ", "77 ", 1), *lines[4:]]),
            good.replace("END", "MORE"),
            good.replace("OBJECTS 2", "OBJECTS 3"),
            good.replace("OBJECTS 2", "OBJECTS x"),
            good.replace(lines[3].split()[7], "nan"),
            good.replace(lines[3].split()[7], "0x10"),
            good.replace(lines[3].split()[7], "1e999"),
        ):
            assert program.run(bad) == "SMC_RNCQ_UNEXPECTED_EOF", bad[:60]
        program.set(nBuffer=4)
        assert program.run(good) == "SMC_RNCQ_BUFFER_TOO_SMALL"
        program.set(nBuffer=8, nPointer=0)
        assert program.run(good) == "SMC_RNCQ_NO_BUFFER"
        program.set(nPointer=1)
        assert program.run(good) == "SMC_NO_ERROR"
        assert program.run(good.replace("\n", "\r\n").rstrip()) == "SMC_NO_ERROR"
