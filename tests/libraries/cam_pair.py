"""A virtual master and slave with the blocks of cams, moved cycle by cycle by what a test gives them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import cache

from linked_application import LoadedApplication, loaded

from tappet.codegen.build import BuildOptions, BuildSession, LibraryReference, build_application
from tappet.codegen.package import CodePackage
from tappet.lang.source import Source

CYCLE = 0.001
POINTS = 12
TAPPETS = 60
CAMS = 3
Point = tuple[float, float, float, float]
DEFAULT: tuple[Point, ...] = ((0, 0, 0, 0), (120, 120, 1, 0), (240, 240, 1, 0), (360, 360, 0, 0))
HALF: tuple[Point, ...] = ((0, 0, 0, 0), (180, 180, 0, 0), (360, 0, 0, 0))
"""Test cam A of the specification."""
FIRST: tuple[Point, ...] = ((0, 0, 0, 0), (180, 180, 1, 0), (360, 360, 1, 0))
SECOND: tuple[Point, ...] = ((0, 0, 1, 0), (180, 180, 1, 0), (360, 360, 0, 0))
"""The cams of cam EX-14 and EX-15."""
ON, OFF, INVERT, TIME = range(4)
POSITIVE, BOTH, NEGATIVE = range(3)
ABSOLUTE, RELATIVE, RAMP_IN, RAMP_IN_POS, RAMP_IN_NEG = range(5)
FAST = {"Velocity": 1e4, "Acceleration": 1e6, "Deceleration": 1e6}
RAMP = {"VelocityDiff": 50.0, "Acceleration": 400.0, "Deceleration": 400.0}
OUTPUTS = {
    "CamIn": ("InSync", "Busy", "Active", "CommandAborted", "Error"),
    "CamOut": ("Done", "Busy", "Error"),
    "Select": ("Done", "Busy", "Error"),
}
MASTER_BLOCKS = {
    "MasterTo": "MC_MoveAbsolute",
    "MasterBy": "MC_MoveRelative",
    "MasterAt": "MC_MoveVelocity",
    "MasterStop": "MC_Stop",
    "MasterSet": "MC_SetPosition",
}
SLAVE_BLOCKS = {
    "SlaveTo": "MC_MoveAbsolute",
    "SlaveAt": "MC_MoveVelocity",
    "SlaveHalt": "MC_Halt",
    "SlaveStop": "MC_Stop",
    "SlaveSet": "MC_SetPosition",
    "SlaveReset": "MC_Reset",
    "SlaveSuper": "MC_MoveSuperImposed",
    "SlaveHaltSuper": "MC_HaltSuperimposed",
    "SlaveOverride": "MC_SetOverride",
}


def _lines(form: str, items: Sequence[tuple[str, ...]]) -> str:
    return "\n".join(form.format(*item) for item in items)


def _cams() -> str:
    return "\n".join(
        f"""    aPoints{n}  : ARRAY[0..{POINTS - 1}] OF SM3_Basic.SMC_CAMXYVA;
    aTappets{n} : ARRAY[0..{TAPPETS - 1}] OF SM3_Basic.SMC_CAMTappet;
    Cam{n}      : SM3_Basic.MC_CAM_REF := (byType := 3, pce := ADR(aPoints{n}), pt := ADR(aTappets{n}));
    Select{n}   : SM3_Basic.MC_CamTableSelect;"""
        for n in range(1, CAMS + 1)
    )


SELECT = "Select{0}(Master := Master, Slave := Slave, CamTable := Cam{0});"
AXIS = f"fTaskCycle := {CYCLE}, fMaxVelocity := 1E7, fMaxAcceleration := 1E12, fMaxDeceleration := 1E12"
PROGRAM = f"""
PROGRAM Main
VAR
    Master, Slave : SM3_Basic.AXIS_REF_VIRTUAL_SM3 := ({AXIS});
    MasterPower, SlavePower : SM3_Basic.MC_Power := (
        Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
{_cams()}
    CamIn1, CamIn2 : SM3_Basic.MC_CamIn;
    CamOut1        : SM3_Basic.MC_CamOut;
    Phasing        : SM3_Basic.MC_Phasing;
    StartPosition  : SM3_Basic.SMC_GetCamSlaveSetPosition;
    Tappet1, Tappet2 : SM3_Basic.SMC_GetTappetValue;
    Register       : SM3_Basic.SMC_CamRegister;
    aTracks        : ARRAY[1..SM3_Basic.MAX_NUM_TAPPETS] OF BOOL;
    nCam1, nCam2   : INT := 1; (* The cams of the CamIn blocks and of the reader *)
    xRegisters     : BOOL;
    xSwitchesAtEnd : BOOL; (* CamIn2 takes over in the call in which CamIn1 has come to its end *)
    pCam           : POINTER TO SM3_Basic.MC_CAM_REF;
{_lines("    {0} : SM3_Basic.{1};", [*MASTER_BLOCKS.items(), *SLAVE_BLOCKS.items()])}
END_VAR
Master.BeginCycle();
Slave.BeginCycle();
MasterPower(Axis := Master);
SlavePower(Axis := Slave);
{_lines("{0}(Axis := Master);", [(name,) for name in MASTER_BLOCKS])}
{_lines("{0}(Axis := Slave);", [(name,) for name in SLAVE_BLOCKS])}
{_lines(SELECT, [(str(n),) for n in range(1, CAMS + 1)])}
CASE nCam1 OF
    1: CamIn1.CamTableID := Select1.CamTableID;
    2: CamIn1.CamTableID := Select2.CamTableID;
    3: CamIn1.CamTableID := Select3.CamTableID;
END_CASE
CASE nCam2 OF
    1: CamIn2.CamTableID := Select1.CamTableID;
    2: CamIn2.CamTableID := Select2.CamTableID;
    3: CamIn2.CamTableID := Select3.CamTableID;
END_CASE
Phasing(Master := Master, Slave := Slave);
CamIn1(Master := Master, Slave := Slave);
Tappet1(Tappets := CamIn1.Tappets);
Tappet2(Tappets := CamIn1.Tappets);
IF xSwitchesAtEnd AND CamIn1.EndOfProfile THEN
    CamIn1(Master := Master, Slave := Slave, Execute := FALSE);
    CamIn2.Execute := TRUE;
END_IF
CamIn2(Master := Master, Slave := Slave);
CamOut1(Slave := Slave);
StartPosition(Master := Master, Slave := Slave, CamTableID := CamIn1.CamTableID);
Register(Master := Master, CamTable := Cam1, bTappet := aTracks);
Master.EndCycle();
Slave.EndCycle();
END_PROGRAM
"""


@cache
def _package() -> CodePackage:
    options = BuildOptions(libraries=(LibraryReference("SM3_Basic"),), level=1)
    result = build_application([Source("program", PROGRAM)], options=options, session=BuildSession())
    assert [str(d) for d in result.diagnostics if d.severity == "error"] == []
    assert result.package is not None
    return result.package


class CamPair:
    """The running program."""

    def __init__(self, application: LoadedApplication) -> None:
        self._application = application

    def set(self, block: str, **inputs: float | bool | str) -> None:
        """Writes inputs of a block, or members of a variable."""
        for name, value in inputs.items():
            self._application.write(f"Main.{block}.{name}", value)

    def write(self, name: str, value: float | bool | str) -> None:
        self._application.write(f"Main.{name}", value)

    def give(self, cam: int, points: Sequence[Point]) -> None:
        """A cam of XYVA points."""
        for index, point in enumerate(points):
            self.set(
                f"aPoints{cam}[{index}]",
                **dict(zip(("dX", "dY", "dV", "dA"), map(float, point), strict=True)),
            )
        self.set(f"Cam{cam}", nElements=len(points), xStart=float(points[0][0]), xEnd=float(points[-1][0]))

    def put_tappets(self, cam: int, *tappets: tuple[int, float, int, int]) -> None:
        """Each with its group, position, directions and action."""
        for index, (group, x, directions, action) in enumerate(tappets):
            self.set(f"aTappets{cam}[{index}]", iGroupID=group, x=float(x), ctt=directions, cta=action)
        self.set(f"Cam{cam}", nTappets=len(tappets))

    def select(
        self, cam: int, periodic: bool = True, master_absolute: bool = True, slave_absolute: bool = True
    ) -> None:
        block = f"Select{cam}"
        self.set(block, Execute=False)
        self.cycle()
        self.set(
            block,
            Execute=True,
            Periodic=periodic,
            MasterAbsolute=master_absolute,
            SlaveAbsolute=slave_absolute,
        )
        self.cycle()
        assert self.says(block, "Done", "Busy", "Error") == {"Done"}

    def start(self, block: str, **inputs: float | bool | str) -> None:
        """Gives a block its inputs and a rising edge, and has one cycle."""
        self.set(block, **inputs, Execute=True)
        self.cycle()

    def couple(self, cam: int = 1, **inputs: float | bool | str) -> None:
        """Couples by CamIn1."""
        self.write("nCam1", cam)
        self.start("CamIn1", **inputs)

    def cycle(self, count: int = 1) -> None:
        for _ in range(count):
            self._application.cycle()
            self._application.clock_ns += round(CYCLE * 1e9)

    def number(self, path: str) -> float:
        return float(self._application.literal(f"Main.{path}"))

    def text(self, path: str) -> str:
        return self._application.literal(f"Main.{path}")

    def true(self, path: str) -> bool:
        return self.text(path) == "TRUE"

    def says(self, block: str, *outputs: str) -> set[str]:
        """Those of the outputs that are TRUE."""
        names = outputs or OUTPUTS[block.rstrip("0123456789")]
        return {name for name in names if self.true(f"{block}.{name}")}

    @property
    def state(self) -> str:
        return self.text("Slave.nAxisState")

    @property
    def master(self) -> float:
        return self.number("Master.fSetPosition")

    @property
    def slave(self) -> float:
        return self.number("Slave.fSetPosition")

    @property
    def velocity(self) -> float:
        return self.number("Slave.fSetVelocity")

    def place(self, master: float, slave: float) -> None:
        """Gives both axes positions."""
        for block, position in (("MasterSet", master), ("SlaveSet", slave)):
            self.set(block, Execute=False)
            self.cycle()
            self.start(block, Position=position)
            self.set(block, Execute=False)
        self.cycle(2)
        assert (self.master, self.slave) == (master, slave)

    def step(self, by: float) -> None:
        """The master moves by a distance at once, and stands."""
        self.set("MasterBy", Execute=False)
        self.cycle()
        self.start("MasterBy", Distance=by, **FAST)
        self.until(lambda: self.true("MasterBy.Done"))
        self.set("MasterBy", Execute=False)
        self.cycle()

    def move(self, to: float) -> None:
        """The master moves to a position, and stands."""
        self.set("MasterTo", Execute=False)
        self.cycle()
        self.start("MasterTo", Position=to, **FAST)
        self.until(lambda: self.true("MasterTo.Done"))

    def run(self, velocity: float) -> None:
        """The master goes at a velocity."""
        self.set("MasterAt", Execute=False)
        self.cycle()
        direction = "positive" if velocity >= 0 else "negative"
        self.set("MasterAt", Velocity=abs(velocity), Acceleration=1e9, Deceleration=1e9)
        self.set("MasterAt", Direction={"positive": 1, "negative": -1}[direction], Execute=True)
        self.cycle(2)
        assert self.number("Master.fSetVelocity") == velocity

    def cycles_until(self, path: str, at_most: int = 20_000) -> Iterator[None]:
        """Cycles until a variable is TRUE, one after the other."""
        for _ in range(at_most):
            if self.true(path):
                return
            self.cycle()
            yield
        raise AssertionError("it never came")

    def until(self, condition: Callable[[], bool], at_most: int = 20_000) -> int:
        """Cycles until a condition holds."""
        for count in range(at_most):
            if condition():
                return count
            self.cycle()
        raise AssertionError("it never came")


@contextmanager
def cam_pair(
    points: Sequence[Point] = DEFAULT, master_period: float = 0.0, slave_period: float = 0.0
) -> Iterator[CamPair]:
    """Fresh axes in standstill, without a period: linear ones; the first cam has the points."""
    with loaded(_package()) as application:
        pair = CamPair(application)
        for axis, period in (("Master", master_period), ("Slave", slave_period)):
            if period:
                pair.set(axis, iMovementType=0, fPositionPeriod=period)
        pair.cycle(5)
        assert pair.state == "standstill"
        pair.give(1, points)
        yield pair
