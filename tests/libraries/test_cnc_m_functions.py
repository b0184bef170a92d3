"""M functions of a path: SMC_GetMParameters and SMC_PreAcknowledgeMFunctions."""

from __future__ import annotations

import numpy as np
import pytest
from tests.libraries.cnc_motion import CAPACITY, MCOMMAND, WAIT, Object, motion, program_text

PARAMETERS = program_text(
    declarations="read : SM3_CNC.SMC_GetMParameters := (bEnable := TRUE); aActive : ARRAY[0..1999] OF LREAL;",
    calls="read(Interpolator := ipo); aActive[n] := BOOL_TO_INT(read.bMActive);",
)
ADVANCE = program_text(
    declarations="ahead, ahead2 : SM3_CNC.SMC_PreAcknowledgeMFunctions := (bEnable := TRUE);",
    producer="ahead(poqDataIn := ADR(queue)); ahead2(poqDataIn := ADR(queue));",
)


def m(number: int, **members: float) -> Object:
    return Object(kind=MCOMMAND, end=0.0, members={"iHelpID[0]": number, **members})


def done_at(found: dict[str, np.ndarray]) -> int:
    return int(np.argmax(found["aDone"] > 0)) + 1


def test_parameters() -> None:
    """Spec cnc_runtime EX-35, CNCR-151: K, L and the parameters, as long as the interpolator waits."""
    words = {f"dP{n}": 10.0 + n for n in range(1, 9)}
    with motion([Object(50.0), m(7, dT1=1.5, dT2=2.0, **words), Object(50.0)], PARAMETERS) as path:
        found = path.calls(160)
        active = np.array(path.program.numbers("Main.aActive"))
        assert active[:160].tolist() == np.concatenate([[0], found["aM"][:-1] == 7]).tolist()
        literal = path.program.literal
        assert (float(literal("Main.read.dK")), float(literal("Main.read.dL"))) == (1.5, 2.0)
        assert [float(literal(f"Main.read.MParameters.dP{n}")) for n in range(1, 9)] == list(words.values())
        path.program.set("Main.read", bEnable=False)
        path.calls(1)
        assert literal("Main.read.bMActive") == "FALSE"
        path.program.set("Main.read", bEnable=True)
        path.set(bAcknM=True)
        path.calls(2)
        assert literal("Main.read.bMActive") == "FALSE"


def test_an_acknowledgement_is_for_one() -> None:
    """CNCR-150: the next one at the same place is waited at; bAcknM TRUE for ever passes each at once."""
    with motion([Object(50.0), m(7), m(9), m(7), Object(50.0)]) as path:
        assert path.calls(160)["aM"][-1] == 7
        seen = []
        for _ in range(3):
            path.set(bAcknM=True)
            seen.append(path.calls(1)["aM"][0])
            path.set(bAcknM=False)
            assert path.calls(5)["aM"].tolist() == [seen[-1]] * 5
        assert seen == [9, 7, 0]
        assert path.calls(160)["aDone"][-1] > 0
    with motion([Object(50.0), m(7), m(9), m(7), Object(50.0)], bAcknM=True) as path:
        assert path.calls(310)["aDone"][-1] > 0


@pytest.mark.parametrize(("number", "calls"), [(7, 250), (8, 300)])
def test_in_advance(number: int, calls: int) -> None:
    """Spec cnc_runtime EX-35, CNCR-152: no stop, wM stays 0; another number does not count."""
    with motion([Object(50.0), m(7), Object(50.0)], ADVANCE, bAcknM=number != 7) as path:
        path.program.set("Main.ahead", iM=number)
        found = path.calls(320)
        assert done_at(found) == calls
        assert found["aM"].max() == 0
        if number == 7:
            assert found["aStatus"].tolist().count(WAIT) == 0
        assert path.program.literal("Main.ahead.bDone") == "TRUE"
        path.program.set("Main.ahead", bEnable=False)
        path.calls(1)
        assert path.program.literal("Main.ahead.bDone") == "FALSE"


def test_several_in_advance_at_one_place() -> None:
    """Two M functions and an empty line between the lines: the path goes over all of them without a stop."""
    path = [Object(50.0), m(7), Object(), m(9), Object(50.0)]
    with motion(path, ADVANCE) as running:
        running.program.set("Main.ahead", iM=7)
        running.program.set("Main.ahead2", iM=9)
        assert done_at(running.calls(320)) == 250


def test_of_a_corner_in_advance() -> None:
    """A corner stays one."""
    with motion([Object(50.0), m(7), Object(dy=50.0)], ADVANCE) as path:
        path.program.set("Main.ahead", iM=7)
        assert done_at(path.calls(320)) == 300


def test_a_wrong_queue() -> None:
    """Spec CNCR-14, 1501."""
    with motion([Object(50.0)], ADVANCE) as path:
        path.calls(1)
        path.program.set("Main.ahead2", bEnable=False)
        path.calls(1)
        path.program.set("Main.ahead2", bEnable=True)
        path.program.set("Main.queue", wOUTQUEUEStructID=1)
        path.calls(1)
        assert path.program.literal("Main.ahead2.wErrorID") == "SMC_NO_OUTQUEUE_TYPE"


def test_a_number_of_the_library_is_none_to_acknowledge() -> None:
    """Dwells are no M functions for the program: iM below 0 finds none."""
    with motion([Object(50.0), m(-1, dP1=0.5), Object(50.0)], ADVANCE) as path:
        path.program.set("Main.ahead", iM=-1)
        assert done_at(path.calls(400)) == 350


def test_as_many_as_the_queue_has() -> None:
    """An M function behind every line, acknowledged at once: each object is passed once, none is lost."""
    path = [item for n in range(CAPACITY // 2 - 4) for item in (Object(0.5), m(n % 90 + 1))]
    with motion(path, PARAMETERS, bAcknM=True, dwIpoTime=20000) as running:
        found = running.calls(2000)
    assert (found["aDone"][-1], found["aLeft"][-1]) == (1, 0)
    assert found["aS"][-1] == pytest.approx(0.5 * (CAPACITY // 2 - 4))
