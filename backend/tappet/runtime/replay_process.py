"""Replays in a process of their own: recorded code that kills its process takes nobody with it.

`python -m tappet.runtime.replay_process` reads one MessagePack map from its input (`ReplayOrder`) and writes
one JSON document: `ReplayResult`.
"""

from __future__ import annotations

import subprocess
import sys
from typing import TYPE_CHECKING

import msgspec
from msgspec import Struct

from tappet.codegen.package import CodePackage, PackageError
from tappet.codegen.symbol_map import SymbolError
from tappet.runtime.exception_report import ExceptionReport
from tappet.runtime.flight_recording import RecordingError, read_recording

if TYPE_CHECKING:
    from tappet.runtime.replay_result import Replayed

LIMIT_S = 600
COMMAND = (sys.executable, "-m", "tappet.runtime.replay_process")


class ReplayOrder(Struct, frozen=True):
    """What to replay."""

    recording: str
    """Text of the file."""
    code: bytes | None = None
    """A package that is an online change of the recorded one: it runs in its place."""
    show: list[str] = []
    until: int | None = None


class ChangedValue(Struct, frozen=True):
    """A variable that is not as recorded."""

    name: str
    recorded: str
    replayed: str


class FirstDifference(Struct, frozen=True):
    """The first cycle whose variables are not as recorded."""

    cycle: int
    variables: list[ChangedValue]


class ReplayResult(Struct, frozen=True):
    """What came of it, or why nothing did."""

    problem: str | None = None
    cycles: int = 0
    last_cycle: int = 0
    recorded: ExceptionReport | None = None
    fault: ExceptionReport | None = None
    same_fault: bool = False
    difference: FirstDifference | None = None
    notes: list[str] = []
    values: dict[str, str] = {}


def result_of(played: Replayed) -> ReplayResult:
    """The outcome as it travels."""
    difference = played.difference
    return ReplayResult(
        cycles=played.cycles,
        last_cycle=played.last_cycle,
        recorded=played.recorded,
        fault=played.fault,
        same_fault=played.same_fault,
        difference=FirstDifference(difference.cycle, [ChangedValue(*row) for row in difference.variables])
        if difference
        else None,
        notes=list(played.notes),
        values=dict(played.values),
    )


def perform(order: ReplayOrder) -> ReplayResult:
    """Carries an order out in this process."""
    from tappet.runtime.replay import replay  # whoever only sends orders does without a soft PLC
    from tappet.runtime.replay_result import ReplayError

    try:
        code = CodePackage.from_bytes(order.code) if order.code is not None else None
        recording = read_recording(order.recording)
        return result_of(replay(recording, code=code, show=order.show, until=order.until))
    except (RecordingError, ReplayError, SymbolError, PackageError) as error:
        return ReplayResult(problem=str(error))


def packed(order: ReplayOrder) -> bytes:
    """The order as the process reads it."""
    return msgspec.msgpack.encode(order)


def unpacked(output: bytes, status: int | None) -> ReplayResult:
    """The result in the output of a process that has ended with `status`; None: it was ended for its time."""
    if status is None:
        return ReplayResult(problem=f"the replay did not come to its end within {LIMIT_S} s")
    if status != 0:
        return ReplayResult(problem=f"the replayed program has ended its process (status {status})")
    return msgspec.json.decode(output, type=ReplayResult)


def replay_in_process(order: ReplayOrder) -> ReplayResult:
    """Carries an order out and waits for its end."""
    try:
        done = subprocess.run(  # noqa: S603 - our own command
            COMMAND, input=packed(order), stdout=subprocess.PIPE, timeout=LIMIT_S, check=False
        )
    except subprocess.TimeoutExpired:
        return unpacked(b"", None)
    return unpacked(done.stdout, done.returncode)


def main() -> None:
    """One order from the input, its result to the output."""
    order = msgspec.msgpack.decode(sys.stdin.buffer.read(), type=ReplayOrder)
    sys.stdout.buffer.write(msgspec.json.encode(perform(order)))


if __name__ == "__main__":
    main()
