"""Pointers that lead anywhere: the process lives and tells the place, or the next one says what ended it.

Each case is a few random accesses (what, from where, how far) in a process of its own. Afterwards the same
process has to run the application again from its initial values; one that died is followed by one that boots.
"""

from __future__ import annotations

import json
import random
import signal
import subprocess
import sys
from collections import Counter
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import pytest

from tappet.codegen.build import BuildOptions, build_application
from tappet.iec.task import Task
from tappet.lang.source import Source

TEXT = """TYPE STEP : STRUCT op, start : DINT; offset : LINT; value : LINT; count : LINT; END_STRUCT END_TYPE
TYPE RECORD : STRUCT numbers : ARRAY[0..30] OF LINT; text : STRING(100); END_STRUCT END_TYPE
FUNCTION_BLOCK Base
VAR n : DINT; END_VAR
METHOD Act : DINT
n := n + 1;
Act := n;
END_METHOD
END_FUNCTION_BLOCK
FUNCTION_BLOCK Derived EXTENDS Base
METHOD Act : DINT
n := n + 2;
Act := n;
END_METHOD
END_FUNCTION_BLOCK
FUNCTION Access : DINT
VAR_INPUT op : DINT; target : LWORD; value : LINT; count : LINT; END_VAR
VAR
    pByte : POINTER TO BYTE; pNumber : POINTER TO LINT; pReal : POINTER TO LREAL;
    pText : POINTER TO STRING(80);
    pRecord : POINTER TO RECORD; pBlock : POINTER TO Base; kept : RECORD; i : LINT;
END_VAR
pByte := target; pNumber := target; pReal := target; pText := target; pRecord := target; pBlock := target;
CASE op OF
    1: pByte^ := LINT_TO_BYTE(value);
    2: pNumber^ := value;
    3: pReal^ := LINT_TO_LREAL(value);
    4: FOR i := 0 TO count - 1 DO pByte[i] := LINT_TO_BYTE(value); END_FOR
    5: Access := LINT_TO_DINT(pNumber^);
    6: pText^ := CONCAT(pText^, 'overwritten');
    7: pRecord^ := kept;
    8: kept := pRecord^;
    9: Access := pBlock^.Act();
    10: __DELETE(pByte);
    11: FOR i := 0 TO count - 1 DO pNumber[i] := pNumber[i] + value; END_FOR
END_CASE
END_FUNCTION
PROGRAM PLC_PRG
VAR
    steps : ARRAY[0..3] OF STEP;
    cycles : DINT;
    i : DINT;
    base : Base; derived : Derived; pBase : POINTER TO Base;
    pMade : POINTER TO BYTE; pOther : POINTER TO LINT;
    result : DINT;
    behind : ARRAY[0..99] OF DINT;
END_VAR
VAR RETAIN kept : DINT; END_VAR
cycles := cycles + 1;
kept := kept + 1;
pMade := __NEW(BYTE, 100);
pOther := __NEW(LINT, 20);
FOR i := 0 TO 3 DO
    CASE steps[i].start OF
        0: result := Access(steps[i].op, steps[i].offset, steps[i].value, steps[i].count);
        1: result := Access(steps[i].op, ADR(behind) + steps[i].offset, steps[i].value, steps[i].count);
        2: result := Access(steps[i].op, pMade + steps[i].offset, steps[i].value, steps[i].count);
        3: result := OnStack(steps[i].op, steps[i].offset, steps[i].value, steps[i].count);
    END_CASE
END_FOR
pBase := ADR(base); result := result + pBase^.Act();
pBase := ADR(derived); result := result + pBase^.Act();
__DELETE(pMade);
__DELETE(pOther);
END_PROGRAM
FUNCTION OnStack : DINT
VAR_INPUT op : DINT; offset : LINT; value : LINT; count : LINT; END_VAR
VAR here : ARRAY[0..9] OF LINT; END_VAR
here[0] := value;
OnStack := Access(op, ADR(here) + offset, value, count) + LINT_TO_DINT(here[1]);
END_FUNCTION
"""
ABSOLUTE, IMAGE, HEAP, STACK = range(4)
FEW, MANY = 60, 4000
TIMEOUT_S = 30


@dataclass(frozen=True)
class Step:
    """What is done (`op` of the text), from where, how far."""

    op: int
    start: int
    offset: int
    value: int
    count: int


def steps_of(seed: int) -> list[Step]:
    """The accesses of a case: near and far, mostly one of them wrong enough to matter."""
    random_ = random.Random(seed)
    steps = []
    for _ in range(random_.randrange(1, 5)):
        start = random_.choice((ABSOLUTE, IMAGE, IMAGE, HEAP, HEAP, STACK, STACK))
        reach = random_.choice((200, 200, 1 << 17, 1 << 28))
        offset = random_.randrange(-reach, reach)
        if start == ABSOLUTE:
            offset = random_.choice(
                (
                    random_.randrange(1 << 14),
                    random_.randrange(0x4000_0000, 0x8000_0000),
                    random_.randrange(1 << 32),
                    random_.randrange(-1 << 63, 1 << 63),
                )
            )
        value = random_.choice((0, 1, -1, 0x4141414141414141, random_.randrange(-1 << 63, 1 << 63)))
        count = random_.choice((1, 8, 100, 1000, 20_000))
        steps.append(Step(random_.randrange(1, 12), start, offset, value, count))
    return steps


CHILD = """
import json, os, signal, sys
from pathlib import Path
from tappet.codegen.package import CodePackage
from tappet.runtime.executive.loader import Executive
from tappet.runtime.local import ApplicationException, LocalRuntime
from tappet.runtime.plc import SoftPlc

folder = Path(sys.argv[1])
data = (folder / "package").read_bytes()
package = CodePackage.from_bytes(data)
Executive.shared()

def run(case):
    place = folder / str(case["seed"])
    place.mkdir()
    (place / "boot.tappet").write_bytes(data)
    with LocalRuntime(package, folder=place, start=False, cycle_limit_s=1.0) as runtime:
        values = {f"PLC_PRG.steps[{i}].{k}": v for i, s in enumerate(case["steps"]) for k, v in s.items()}
        runtime.write_all(values)
        runtime.start()
        outcome = {"ended": "run"}
        try:
            runtime.run(cycles=3)
        except ApplicationException as error:
            report = error.report
            outcome = {"ended": report.name, "pou": report.pou, "line": report.line, "text": report.message}
        runtime.reset("cold")
        runtime.start()
        runtime.run(cycles=3)
        assert runtime.read("PLC_PRG.cycles") == 3
    return outcome

def boot(case):
    plc = SoftPlc(folder / str(case["seed"]), virtual=True)
    assert plc.boot()
    report = plc.exception()
    outcome = {"state": plc.state, "name": "", "text": "", "pou": ""}
    if report is not None:
        outcome |= {"name": report.name, "text": report.message, "pou": report.pou}
    plc.start()
    outcome["then"] = plc.state
    plc.close()
    return outcome

def apart(what, case):
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        signal.alarm(20)
        status = 3
        try:
            os.write(write, json.dumps(what(case)).encode())
            status = 0
        finally:
            os._exit(status)
    os.close(write)
    with os.fdopen(read) as pipe:
        said = pipe.read()
    _, status = os.waitpid(child, 0)
    return (-os.WTERMSIG(status) if os.WIFSIGNALED(status) else os.WEXITSTATUS(status)), said

for line in sys.stdin:
    case = json.loads(line)
    code, said = apart(run, case)
    outcome = {"seed": case["seed"], "code": code, "said": json.loads(said) if said else None}
    if code < 0:
        code, said = apart(boot, case)
        outcome["boot"] = {"code": code, **(json.loads(said) if said else {})}
    print(json.dumps(outcome), flush=True)
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    found: Path = tmp_path_factory.mktemp("wild")
    tasks = (Task("Main", interval_ns=10_000_000, programs=("PLC_PRG",)),)
    result = build_application([Source("wild", TEXT)], tasks, BuildOptions())
    assert result.package is not None, [d for d in result.diagnostics if d.severity == "error"]
    (found / "package").write_bytes(result.package.to_bytes())
    return found


def outcomes(folder: Path, seeds: range) -> list[dict[str, Any]]:
    """What became of each case."""
    lines = [json.dumps({"seed": s, "steps": [asdict(step) for step in steps_of(s)]}) for s in seeds]
    done = subprocess.run(
        [sys.executable, "-c", CHILD, str(folder)],
        input="\n".join(lines),
        capture_output=True,
        text=True,
        timeout=TIMEOUT_S + 5 * len(lines),
    )
    assert done.returncode == 0, done.stderr[-2000:]
    return [json.loads(line) for line in done.stdout.splitlines()]


def judge(found: list[dict[str, Any]]) -> Counter[str]:
    """Fails at what must not be; counts the rest."""
    kinds: Counter[str] = Counter()
    for one in found:
        if one["code"] < 0:
            ended = signal.Signals(-one["code"]).name
            assert ended != "SIGALRM", f"hangs: {one}"
            booted = one["boot"]
            assert booted["code"] == 0, one
            wanted = ("exception", "PROCESS_ENDED", "run")
            assert (booted["state"], booted["name"], booted["then"]) == wanted, one
            assert ended in booted["text"], one
            assert any(step.start == STACK for step in steps_of(one["seed"])), (
                f"nothing else may do that: {one}"
            )
            kinds[ended] += 1
            continue
        assert one["code"] == 0, one
        said = one["said"]
        kinds[said["ended"]] += 1
        if said["ended"] != "run" and not any(step.start == STACK for step in steps_of(one["seed"])):
            assert said["pou"], one
            assert said["line"], one
    return kinds


def test_a_few_cases(folder: Path) -> None:
    kinds = judge(outcomes(folder, range(FEW)))
    assert sum(kinds.values()) == FEW
    for kind in ("run", "ACCESS_VIOLATION", "INVALID_RELEASE"):
        assert kinds[kind] > 0, kinds


@pytest.mark.slow
def test_thousands_of_cases(folder: Path) -> None:
    kinds = judge(outcomes(folder, range(FEW, FEW + MANY)))
    print(dict(kinds))
    assert sum(kinds.values()) == MANY
    for kind in ("run", "ACCESS_VIOLATION", "NULL_REFERENCE", "INVALID_RELEASE", "HEAP_DAMAGED", "SIGSEGV"):
        assert kinds[kind] > 0, kinds
