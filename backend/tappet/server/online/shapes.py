"""Messages of the WebSocket `/api/v1/online`.

Samples are binary frames, little endian: u32 subscription, u32 flags (1: of a past cycle), u64 cycle, i64
nanoseconds since 1970 (0 in frames of the past: the list of past cycles has the times), then the values as
raw bytes; the offsets of the `subscribed` message count from the end of this header.
"""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from tappet.server.flight.shapes import Cycle
from tappet.server.runtimes.shapes import RuntimeState
from tappet.server.shapes import Reply, Request
from tappet.server.values.shapes import MAX_EXPRESSIONS, Expression
from tappet.translation.language import Language

SubscriptionId = Annotated[int, Field(ge=0, le=0xFFFFFFFF, strict=True)]


class Subscribe(Request):
    """Ask for values; a second one with the same id replaces the first."""

    op: Literal["subscribe"]
    id: SubscriptionId
    expressions: Annotated[list[Expression], Field(max_length=MAX_EXPRESSIONS)]
    interval_ms: Annotated[int, Field(ge=10, le=60_000)] = 100


class Unsubscribe(Request):
    """End a subscription."""

    op: Literal["unsubscribe"]
    id: SubscriptionId


class Speak(Request):
    """The language of sentences from now on, English before; state and layouts are sent again in it."""

    op: Literal["speak"]
    language: Language


class LookBack(Request):
    """Show the end of a past cycle that the flight recorder keeps in all subscriptions, later ones as well;
    null: live values again."""

    op: Literal["look_back"]
    cycle: Cycle | None


ClientMessage = Annotated[Subscribe | Unsubscribe | Speak | LookBack, Field(discriminator="op")]


class ImagePlace(Reply):
    """Bytes of the memory image, or one bit of the byte at `offset`."""

    offset: int
    size: int
    bit: int | None = None


class Item(Reply):
    """How to read one value of the frames. `kind` is `error` when there is none; structures and arrays have
    no bytes of their own (size 0)."""

    SENTENCES: ClassVar = ("error",)

    expression: str
    offset: int = Field(description="Bytes from the end of the frame's header.")
    size: int
    type: str
    kind: str = Field(description="bool bits int uint real time date ... enum string wstring error.")
    enum: dict[str, int] | None = Field(default=None, description="Numbers of an enumeration by name.")
    base: str | None = Field(default=None, description="int, uint or bits below an enumeration.")
    bit: int | None = Field(default=None, description="Bit of the byte, counted from 0.")
    flags: tuple[str, ...] = Field(
        default=(), description="Of CONSTANT, RETAIN, PERSISTENT, DISPLAY_HEX, DISPLAY_BIN, DISPLAY_DEC."
    )
    section: str = ""
    place: ImagePlace | None = Field(
        default=None, description="Where it lies: two names of one place, or parts of it, share a force."
    )
    error: str | None = None


class Subscribed(Reply):
    """The layout of the frames that follow; sent again when it changes (download, reconnection)."""

    op: Literal["subscribed"] = "subscribed"
    id: int
    items: list[Item]
    interval_ms: int = Field(description="The one asked for, or a longer one: see `paced`.")
    renewed: bool = Field(default=False, description="Set up again after a lost connection or a download.")


class Paced(Reply):
    """A subscription has another interval now, because its user watches more, or less, than before."""

    op: Literal["paced"] = "paced"
    id: int
    interval_ms: int


class StateChanged(RuntimeState):
    """The runtime's state; the first message after opening, then at every change."""

    op: Literal["state"] = "state"


class ForcesChanged(Reply):
    """All forced variables."""

    op: Literal["forces"] = "forces"
    expressions: list[str]
    places: list[ImagePlace]


class LookedBack(Reply):
    """What the subscriptions show from now on."""

    SENTENCES: ClassVar = ("problem",)

    op: Literal["looked_back"] = "looked_back"
    cycle: int | None = Field(description="The past cycle; null: live values.")
    problem: str | None = Field(default=None, description="Why the cycle asked for cannot be shown.")


class OnlineError(Reply):
    """A message that could not be served; the connection stays open."""

    SENTENCES: ClassVar = ("detail",)

    op: Literal["error"] = "error"
    id: int | None = None
    detail: str


ServerMessage = Annotated[
    Subscribed | Paced | StateChanged | ForcesChanged | LookedBack | OnlineError, Field(discriminator="op")
]
