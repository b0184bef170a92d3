"""What a wire operation is: a type whose fields are the arguments, with its reply, its handler and its route.

    class Read(Operation[list[bytes]]):
        '''Bytes at (offset, size) places of the image.'''

        op: ClassVar[str] = "read"
        places: Places

        def run(self, plc: SoftPlc) -> list[bytes]:
            return plc.read(self.places)

Arguments and replies are msgspec structures, dataclasses and plain values. The types of the fields are the
checks: a wrong argument is refused before the handler runs, by the name of the operation and of the field.
Handlers run in a worker thread, never in a task; one that takes its time delays only its own connection.
"""

from __future__ import annotations

import asyncio
from abc import abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Generic, Literal, Protocol, TypeVar, get_args

from msgspec import Meta, Struct

from tappet.codegen.symbol_types import Bit

if TYPE_CHECKING:
    from tappet.runtime.plc import SoftPlc
    from tappet.runtime.subscriptions import Subscriptions

Reply = TypeVar("Reply")
State = TypeVar("State")
Role = Literal["viewer", "operator", "engineer", "admin"]
MAX_ITEMS = 100_000
"""Largest number of places in one request."""
MAX_TEXT = 4096

Offset = Annotated[int, Meta(ge=0, lt=1 << 48)]
"""Byte of the image."""
Size = Annotated[int, Meta(ge=1, lt=1 << 48)]
Count = Annotated[int, Meta(ge=0, le=(1 << 63) - 1)]
Text = Annotated[str, Meta(max_length=MAX_TEXT)]
CodeId = Annotated[
    Text,
    Meta(description="Of the application whose places these are; refused when it is not the loaded one."),
]
Places = Annotated[list[tuple[Offset, Size]], Meta(max_length=MAX_ITEMS)]
Values = Annotated[list[tuple[Offset, bytes, Bit | None]], Meta(max_length=MAX_ITEMS)]
"""(offset, bytes, bit); for a bit one byte, 0 or 1."""


class OperationError(ValueError):
    """The operation cannot be served; `code` is for programs (REST answers 404 to `not_found`)."""

    def __init__(self, code: str, message: str) -> None:
        super().__init__(message)
        self.code = code


@dataclass(frozen=True, slots=True)
class Fact:
    """What the audit log keeps of an operation. The subject is the runtime where none is given."""

    action: str
    """A stable word such as `start`."""
    subject: str = ""
    new_value: str | None = None


@dataclass(frozen=True, slots=True)
class Rest:
    """The REST route of an operation, below `/api/v1/runtimes/{runtime_id}`.

    Arguments named in braces in `path` are taken from there, the others from the query (GET, DELETE) or from
    the JSON body.
    """

    method: Literal["GET", "POST", "PUT", "DELETE"]
    path: str
    role: Role
    """Least role that may."""
    audit: Callable[[Any], Fact] | None
    """From the operation to what is recorded of it; None for what changes nothing."""
    answer: Callable[[Any], Any] | Literal["reply", "state"] = "reply"
    """The JSON answered: the reply, the state of the runtime, or what an annotated function makes of the
    reply."""
    tag: str = "runtimes"
    """Chapter of the API document."""
    variant: bool = False
    """It needs the instrumented variant of the application: the server loads that before."""
    always: bool = False
    """It stops something: it is done even when the audit log takes no row, and recorded later."""


class Session(Protocol):
    """The connection over which a request came."""

    @property
    def plc(self) -> SoftPlc:
        """The soft PLC."""

    @property
    def subscriptions(self) -> Subscriptions:
        """Recorders of this connection."""

    def own(self, kind: type[State]) -> State:
        """State that an operation keeps with the connection: made at first use, gone with it."""


class WireOperation(Struct, Generic[Reply], frozen=True, forbid_unknown_fields=True):
    """One request; its docstring is what the API document says."""

    op: ClassVar[str] = ""
    """Name on the wire."""
    rest: ClassVar[Rest | None] = None
    of_recordings: ClassVar[bool] = False
    """A recording of the flight recorder answers it as a controller does."""

    @abstractmethod
    async def serve(self, session: Session) -> Reply:
        """Do it, on the event loop. Raises PlcError, ValueError, OperationError."""


class Operation(WireOperation[Reply], Generic[Reply], frozen=True):
    """A request that needs the soft PLC alone."""

    @abstractmethod
    def run(self, plc: SoftPlc) -> Reply:
        """Do it, in a worker thread. Raises PlcError, ValueError, OperationError."""

    async def serve(self, session: Session) -> Reply:
        """Blocks a worker thread, not the connections."""
        return await asyncio.to_thread(self.run, session.plc)


class SessionOperation(WireOperation[Reply], Generic[Reply], frozen=True):
    """A request that needs what its connection keeps; blocking work goes to a thread by itself."""

    @abstractmethod
    async def serve(self, session: Session) -> Reply:
        """Do it, on the event loop. Raises PlcError, ValueError, OperationError."""


def missing_handler(operation: type[WireOperation[Any]]) -> str | None:
    """The method that an operation leaves abstract. The metaclass of structures does not look for them."""
    for name in ("run", "serve"):
        if getattr(getattr(operation, name, None), "__isabstractmethod__", False):
            return name
    return None


def reply_type(operation: type[WireOperation[Any]]) -> Any:
    """The type an operation answers with, as its bases declare it."""
    for kind in operation.__mro__:
        for base in kind.__dict__.get("__orig_bases__", ()):
            if base is not Generic and (given := get_args(base)) and not isinstance(given[0], TypeVar):
                return given[0]
    raise TypeError(f"{operation.__name__} declares no reply: derive it from Operation[...]")
