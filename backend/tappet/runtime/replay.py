"""Replays a recording of the flight recorder on virtual time: with what came from outside, cycle by cycle.

The recorded code is loaded, the image of the first kept cycle put into place, and each further cycle gets the
inputs, writes, forces and the time that it had. With equal code the images are compared cycle by cycle. With
other code (today's, as an online change of the recorded one) the variables that both have are compared, but
the end counts: whether it fails.

Other tasks run where they ran: with each cycle of the bus cycle task it is recorded how many cycles of them
had ended. Where tasks ran at the same time, the order that leads nearest to the recorded values is found with
the recorded code (`replay_orders`), and other code runs in it. Not recorded, and so not replayed: memory of
`__NEW`, files, the moments inside a cycle at which a program reads the clock, and what tasks that ran at the
same time have seen of each other in the midst of their cycles. docs/flight-recorder.md tells users.
"""

from __future__ import annotations

from collections.abc import Sequence

from tappet.codegen.package import CodePackage
from tappet.iec.memory import MAX_IMAGE
from tappet.runtime.flight import LEAST_MEMORY, FlightSettings
from tappet.runtime.flight_recording import FlightRecording
from tappet.runtime.local import LocalRuntime
from tappet.runtime.replay_orders import FoundOrders, orders_differ
from tappet.runtime.replay_result import Replayed, ReplayError
from tappet.runtime.replay_run import ReplayRun

_ENTRIES = 6
"""Images of which the flight recorder of a replay has room: it tells what was at the end of a cycle of the
bus cycle task, though other tasks come behind it."""


def replay(
    recording: FlightRecording,
    *,
    code: CodePackage | None = None,
    show: Sequence[str] = (),
    until: int | None = None,
) -> Replayed:
    """Runs the recording again, up to the cycle `until` where one is given. `code` is an online change of
    the recorded code: it runs in its place. Raises RecordingError, ReplayError, and SymbolError for what
    cannot be shown."""
    if recording.bus is None:
        raise ReplayError("the recording has no bus cycle task, so it has no cycles to run")
    if recording.period != 1:
        raise ReplayError(f"the recording has every {recording.period}th cycle only; all of them are needed")
    if recording.parts != 1:
        raise ReplayError("the recorded image is so large that each cycle holds a part of it only")
    package = recording.code()
    largest = max(package.image_size, code.image_size if code is not None else 0)
    room = FlightSettings(memory=LEAST_MEMORY + _ENTRIES * largest, scan_limit=MAX_IMAGE)
    for expression in show:
        (code or package).symbols.resolve(expression)

    def run(orders: FoundOrders, code: CodePackage | None, show: Sequence[str]) -> Replayed | None:
        with LocalRuntime(
            package, start=False, flight=room, image_address=recording.image_address
        ) as runtime:
            return ReplayRun(recording, package, runtime, orders).run(code, show, until)

    orders = FoundOrders()
    if code is None or any(map(orders_differ(recording.bus), recording.cycles)):
        while (played := run(orders, None, show if code is None else ())) is None:
            pass  # an order that ends in another fault than the recorded one is avoided from now on
        if code is None:
            return played
    played = run(orders.fixed(), code, show)
    assert played is not None
    return played
