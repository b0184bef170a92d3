"""The channels of drives and what they are bound to: addresses or variables (AXIS-22, AXIS-46, AXIS-47).

A channel is a member of `in` or `out` of an axis. Mapped automatically, the program or a bus writes and reads
these members itself. Else each channel has an address or a variable with a type, and the build makes the
assignments around the cycle of the axis. `python -m tappet.project.axes.channels` prints the table that the
editor shows.
"""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass
from itertools import pairwise
from typing import Literal

from pydantic import Field, StrictBool

from tappet.project.data import Data, Line

ChannelType = Literal["BOOL", "BYTE", "SINT", "USINT", "WORD", "INT", "UINT", "DWORD", "DINT", "UDINT"]
BITS: dict[str, int] = {
    "BOOL": 1,
    **dict.fromkeys(("BYTE", "SINT", "USINT"), 8),
    **dict.fromkeys(("WORD", "INT", "UINT"), 16),
    **dict.fromkeys(("DWORD", "DINT", "UDINT"), 32),
}
_ADDRESSED = {1: "BOOL", 8: "BYTE", 16: "WORD", 32: "DWORD"}
"""What an address of so many bits is."""
_SIZES = {1: "X", 8: "B", 16: "W", 32: "D"}
_ADDRESS = re.compile(r"%([IQM])([XBWD])(\d+)(?:\.([0-7]))?", re.IGNORECASE)
_VARIABLE = re.compile(r"[A-Za-z_]\w*(?:\[\d+\])*(?:\.[A-Za-z_]\w*(?:\[\d+\])*)*", re.ASCII)


@dataclass(frozen=True, slots=True)
class Channel:
    """A member of `in` or `out` that a drive may have."""

    name: str
    """Its path from the axis, such as `in.wStatusWord`."""
    type: ChannelType
    index: str = ""
    """Object of CiA 402."""
    needed: bool = False
    """Whether an axis cannot move without it."""

    @property
    def is_input(self) -> bool:
        """Whether the drive tells it the axis."""
        return self.name.startswith("in.")


CIA402 = (
    Channel("in.wStatusWord", "WORD", "6041h", needed=True),
    Channel("in.byModesOfOperationDisplay", "BYTE", "6061h"),
    Channel("in.diActPosition", "DINT", "6064h", needed=True),
    Channel("in.diActVelocity", "DINT", "606Ch"),
    Channel("in.wActTorque", "INT", "6077h"),
    Channel("in.wErrorCode", "WORD", "603Fh"),
    Channel("in.dwDigitalInputs", "DWORD", "60FDh"),
    Channel("in.wTouchProbeStatus", "WORD", "60B9h"),
    Channel("in.diTouchProbePosition[0]", "DINT", "60BAh"),
    Channel("in.diTouchProbePosition[1]", "DINT", "60BCh"),
    Channel("in.bOffline", "BOOL"),
    Channel("out.wControlWord", "WORD", "6040h", needed=True),
    Channel("out.byModesOfOperation", "BYTE", "6060h"),
    Channel("out.diSetPosition", "DINT", "607Ah", needed=True),
    Channel("out.diSetVelocity", "DINT", "60FFh"),
    Channel("out.wSetTorque", "INT", "6071h"),
    Channel("out.dwDigitalOutputs", "DWORD", "60FEh"),
    Channel("out.wTouchProbeFunction", "WORD", "60B8h"),
    Channel("out.udiProfileVelocity", "UDINT", "6081h"),
    Channel("out.udiProfileAcceleration", "UDINT", "6083h"),
    Channel("out.udiProfileDeceleration", "UDINT", "6084h"),
)
"""Of a drive that speaks CiA 402."""
SPEED = (
    Channel("in.wActPosition", "WORD"),
    Channel("in.dwActPosition", "DWORD"),
    Channel("in.bLimitPos", "BOOL"),
    Channel("in.bLimitNeg", "BOOL"),
    Channel("in.bExternalError", "BOOL"),
    Channel("in.bRegulatorRealState", "BOOL", needed=True),
    Channel("in.bDriveStartRealState", "BOOL", needed=True),
    Channel("in.bOffline", "BOOL"),
    Channel("out.bRegulatorOn", "BOOL"),
    Channel("out.bDriveStart", "BOOL"),
    Channel("out.iSetVelocity", "INT"),
    Channel("out.diSetVelocity", "DINT"),
)
"""Of a drive that follows a speed."""
CHANNELS: Mapping[str, tuple[Channel, ...]] = {"SM_Drive_GenericDSP402": CIA402, "SM_Drive_PosControl": SPEED}
"""By drive; others have none that could be bound."""


class Binding(Data):
    """What a channel is bound to."""

    place: Line = Field(default="", description="An address such as %IW0, or a variable; empty: not bound.")
    type: ChannelType = Field(description="Type of the value there.")


class ChannelMapping(Data):
    """How the channels of a drive are bound to its axis (AXIS-22)."""

    automatic: StrictBool = Field(
        default=True, description="The program or a bus writes `in` and reads `out` of the axis."
    )
    channels: dict[str, Binding] = Field(default={}, description="Else what each channel is bound to.")


def bound(drive: str, mapping: ChannelMapping) -> Iterator[tuple[Channel, Binding]]:
    """The channels that are bound, in the order of the table."""
    if not mapping.automatic:
        for channel in CHANNELS.get(drive, ()):
            binding = mapping.channels.get(channel.name)
            if binding is not None and binding.place.strip():
                yield channel, binding


def fault(channel: Channel, binding: Binding) -> str:
    """Why a channel cannot be bound like this; empty where it can, as far as its own row says."""
    place = binding.place.strip()
    bits, wanted = BITS[binding.type], BITS[channel.type]
    if (bits == 1) != (wanted == 1):
        return f"{channel.name} is {channel.type}, so {binding.type} does not fit; choose {_fitting(channel)}"
    if channel.is_input and bits > wanted:
        return f"{binding.type} has more bits than {channel.name} takes; choose {_fitting(channel)}"
    if not channel.is_input and bits < wanted:
        return f"{binding.type} has less bits than {channel.name} needs; choose {_fitting(channel)}"
    address = _ADDRESS.fullmatch(place)
    if address is None:
        if place.startswith("%"):
            return f"{place} is no address; write one such as {_example(channel, bits)}"
        return (
            "" if _VARIABLE.fullmatch(place) else f"{place} is neither an address nor the name of a variable"
        )
    area, size, _, bit = address.groups()
    if not channel.is_input and area.upper() == "I":
        return f"{place} is an input; {channel.name} goes to an output such as {_example(channel, bits)}"
    if size.upper() != _SIZES[bits] or (bits == 1) != (bit is not None):
        return f"{place} is no place of {binding.type}; write one such as {_example(channel, bits)}"
    return ""


def _fitting(channel: Channel) -> str:
    wanted = BITS[channel.type]
    fitting = [
        name
        for name, bits in BITS.items()
        if (bits == 1) == (wanted == 1) and (bits <= wanted if channel.is_input else bits >= wanted)
    ]
    return ", ".join(fitting)


def _example(channel: Channel, bits: int) -> str:
    return f"%{'I' if channel.is_input else 'Q'}{_SIZES[bits]}{'0.0' if bits == 1 else '0'}"


def assignment(axis: str, channel: Channel, binding: Binding) -> str:
    """The statement that carries a channel, or an error that says why there is none."""
    wrong = fault(channel, binding)
    if wrong:
        return f"{{error '{_quoted(wrong)}'}}"
    place = binding.place.strip()
    at_place = _ADDRESSED[BITS[binding.type]] if place.startswith("%") else binding.type
    member = f"{axis}.{channel.name}"
    types = (at_place, binding.type, channel.type)
    if channel.is_input:
        return f"{member} := {_converted(place, types)};"
    return f"{place} := {_converted(member, types[::-1])};"


def _quoted(text: str) -> str:
    return text.replace("$", "$$").replace("'", "$'").replace("}", ")").replace("{", "(")


def _converted(value: str, types: tuple[str, ...]) -> str:
    """A value of the first type as one of the last."""
    for given, wanted in pairwise(types):
        if given != wanted:
            value = f"{given}_TO_{wanted}({value})"
    return value


def table() -> str:
    """The channels by drive, as JSON."""
    found = {drive: [asdict(channel) for channel in channels] for drive, channels in CHANNELS.items()}
    return json.dumps({"channels": found, "bits": BITS}, indent=2) + "\n"


if __name__ == "__main__":
    sys.stdout.write(table())
