"""Recordings as files: what they hold, and what is refused of damaged ones."""

from __future__ import annotations

import base64
import hashlib
import zlib
from contextlib import suppress
from random import Random

import msgspec
import pytest
from hypothesis import HealthCheck, given
from hypothesis import settings as profile
from hypothesis import strategies as st
from plc_programs import MS, build

from tappet.iec.task import Task
from tappet.runtime.flight_past import RecordedPast
from tappet.runtime.flight_recording import (
    FlightRecording,
    RecordingError,
    read_recording,
    write_recording,
)
from tappet.runtime.local import ApplicationException, LocalRuntime

TEXT = """
PROGRAM PLC_PRG
VAR n : DINT; table : ARRAY [0..63] OF DINT; zero : DINT; big : ARRAY [0..2999] OF LWORD; END_VAR
n := n + 1;
table[n MOD 64] := n;
zero := 1000 / (150 - n);
END_PROGRAM
"""


@pytest.fixture(scope="module")
def recorded() -> tuple[FlightRecording, list[bytes]]:
    """A recording up to the fault in cycle 150, and the image after each cycle, seen by the test itself."""
    images = []
    with LocalRuntime(build(TEXT, [Task("Main", interval_ns=10 * MS, programs=("PLC_PRG",))])) as runtime:
        application = runtime.plc.application
        assert application is not None
        while runtime.exception is None:
            with suppress(ApplicationException):
                runtime.run(1)
            images.append(application.image.read(0, application.image.size))
        return runtime.plc.flight_recording(), images


def test_every_image_is_rebuilt_from_any_side(recorded: tuple[FlightRecording, list[bytes]]) -> None:
    recording, images = recorded
    past = RecordedPast(read_recording(write_recording(recording)))
    assert len(past.cycles) == len(images) == 150
    size = recording.image_size
    assert [image[:size] for image in past.forward()] == images
    order = list(range(150)) * 2
    Random(4).shuffle(order)
    for index in order:
        assert past.image(index)[:size] == images[index], index


def test_a_file_holds_all_of_it(recorded: tuple[FlightRecording, list[bytes]]) -> None:
    recording, _ = recorded
    text = write_recording(recording)
    assert max(map(len, text.splitlines())) <= 100
    again = read_recording(text)
    assert again == recording
    assert read_recording(text.replace("\n", "\r\n", 1).replace("\r\n", "\n")) == recording
    assert again.exception is not None
    assert (again.exception.name, again.exception.cycle) == ("DIV_ZERO", 150)
    assert again.code().application == recording.application


def test_what_is_too_long_loses_its_oldest_cycles(recorded: tuple[FlightRecording, list[bytes]]) -> None:
    recording, images = recorded
    noise = Random(1)
    loud = msgspec.structs.replace(
        recording,
        cycles=[
            msgspec.structs.replace(
                one, delta=(0).to_bytes(4, "little") + (64).to_bytes(4, "little") + noise.randbytes(64)
            )
            for one in recording.cycles
        ],
    )
    whole = len(write_recording(loud))
    short = read_recording(write_recording(loud, whole - 4000))
    assert 1 < len(short.cycles) < 150
    assert short.cycles == loud.cycles[-len(short.cycles) :]
    with pytest.raises(RecordingError, match="too large"):
        write_recording(recording, 1000)
    del images


DONE = [[0, 2, 2, 0, 0]]
"""The one task has run one cycle."""


def _file(content: object) -> str:
    packed = zlib.compress(msgspec.msgpack.encode(content))
    digest = hashlib.sha256(packed).hexdigest()
    return f"TAPPET-FLIGHT 2 sha256={digest}\n{base64.b64encode(packed).decode()}\n"


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"cycles": []}, "no cycle"),
        ({"base": b""}, "0 bytes instead of"),
        ({"image_size": 64}, "bytes instead of 64"),
        ({"bus": 3}, "no task number 3"),
        ({"bus": -1}, "damaged"),
        ({"writes": [{"task": 7, "cycle": 1, "values": []}]}, "no task number 7"),
        ({"writes": [{"task": 0, "cycle": 1, "values": [[1 << 27, None, b"abc"]]}]}, "outside its image"),
        ({"forces": [{"cycle": 1, "values": [[5, 9, b"a"]]}]}, "damaged"),
        ({"cycles": [[2, 1, 1, b"", DONE], [2, 2, 2, b"", DONE]]}, "comes behind cycle 2"),
        ({"cycles": [[2, 1, 1, b"x" * 80, DONE]]}, "cycle 2 of the recording is damaged"),
        ({"cycles": [[2, 1, 1, b"\0\0\0\0\x40\0\0", DONE]]}, "cycle 2 of the recording is damaged"),
        ({"cycles": [[2, 1, 1, b"", []]]}, "cycle 2 of the recording has 0 tasks of 1"),
        (
            {"cycles": [[2, 1, 1, b"", DONE], [3, 2, 2, b"", [[0, 0, 2, 2, 2]]]]},
            "has run -1 cycles up to cycle 3",
        ),
        ({"cycles": [[2, 1, 1, b"", DONE], [3, 2, 2, b"", [[0, 1 << 40, 2, 2, 2]]]]}, "up to cycle 3"),
        ({"cycles": [[2, 1, 1, b"", [[0, -2, 2, 2, 2]]]]}, "damaged"),
        ({"period": 0}, "damaged"),
        ({"application": 7}, "damaged"),
    ],
)
def test_what_does_not_fit_is_refused(
    recorded: tuple[FlightRecording, list[bytes]], change: dict[str, object], says: str
) -> None:
    content = msgspec.msgpack.decode(msgspec.msgpack.encode(recorded[0]))
    with pytest.raises(RecordingError, match=says):
        read_recording(_file({**content, **change}))


def test_code_that_does_not_belong_to_it_is_refused(recorded: tuple[FlightRecording, list[bytes]]) -> None:
    with pytest.raises(RecordingError, match="no usable code"):
        msgspec.structs.replace(recorded[0], package=b"TAPPET-PKG?").code()
    small = msgspec.structs.replace(recorded[0], image_size=64)
    with pytest.raises(RecordingError, match="64 bytes, that of its code"):
        small.code()


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", "no recording"),
        ("PROGRAM PLC_PRG\nEND_PROGRAM\n", "no recording"),
        ("TAPPET-FLIGHT 1 sha256=" + "0" * 64 + "\n", "version 1"),
        ("TAPPET-FLIGHT 2 sha256=" + "0" * 64 + "\nAAAA\n", "digest"),
        ("TAPPET-FLIGHT 2 sha256=" + "0" * 64 + "\nÄAAA\n", "damaged"),
        ("TAPPET-FLIGHT 2 sha256=" + hashlib.sha256(b"").hexdigest() + "\n", "cut off"),
    ],
)
def test_foreign_text_is_refused(text: str, says: str) -> None:
    with pytest.raises(RecordingError, match=says):
        read_recording(text)


@profile(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data())
def test_any_damage_is_found(recorded: tuple[FlightRecording, list[bytes]], data: st.DataObject) -> None:
    text = write_recording(recorded[0])
    at = data.draw(st.integers(0, len(text) - 1))
    other = data.draw(st.sampled_from("AbZ09+/=\n x"))
    damaged = text[:at] + other + text[at + 1 :]
    if "".join(damaged.split()) == "".join(text.split()):
        return
    with pytest.raises(RecordingError):
        read_recording(damaged)
    with pytest.raises(RecordingError):
        read_recording(text[: at - 1] if at > 3 else text[:3])
