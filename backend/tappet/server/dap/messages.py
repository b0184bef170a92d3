"""Messages of the Debug Adapter Protocol 1.69: requests with typed arguments, answers, events.

https://microsoft.github.io/debug-adapter-protocol/specification. Fields that clients may send and nobody here
reads are left out: unknown fields are ignored, as the protocol demands.
"""

from __future__ import annotations

from typing import Any, Literal, TypeVar

from msgspec import DecodeError, Raw, Struct, ValidationError, field, json

from tappet.server.lsp.utf16 import without_half_pairs

T = TypeVar("T")


class MessageError(ValueError):
    """What came is no request, or its arguments are not as they should be."""


class Request(Struct, frozen=True):
    """A request of the client."""

    seq: int
    type: Literal["request"]
    command: str
    arguments: Raw = Raw(b"{}")


class Source(Struct, frozen=True, rename="camel", omit_defaults=True):
    """A text: a file of the client, or one that it asks for by number."""

    name: str | None = None
    path: str | None = None
    source_reference: int = 0


class SourceBreakpoint(Struct, frozen=True, rename="camel"):
    """A wanted breakpoint; lines as the client counts them."""

    line: int
    column: int | None = None
    condition: str | None = None
    hit_condition: str | None = None
    log_message: str | None = None


class Initialize(Struct, frozen=True, rename="camel"):
    """Arguments of `initialize`."""

    adapter_id: str = field(name="adapterID", default="")
    client_name: str | None = None
    locale: str | None = None
    lines_start_at1: bool = True
    columns_start_at1: bool = True
    path_format: str = "path"
    supports_variable_type: bool = False


class Launch(Struct, frozen=True, rename="camel"):
    """Arguments of `launch`: build, and run in a soft PLC of the adapter's own."""

    program: str
    """Project folder, or `.st` file or folder."""
    application: str | None = None
    stop_on_entry: bool = False
    no_debug: bool = False
    values: dict[str, str | int | float | bool] = {}
    """Written before the first cycle."""


class Attach(Struct, frozen=True, rename="camel"):
    """Arguments of `attach`: a runtime that runs what is built of `program`.

    On the WebSocket of the server, which knows both, there are none.
    """

    program: str = ""
    runtime: str = ""
    """`ws://host:port`."""
    application: str | None = None
    token_file: str | None = None
    download: bool = False
    """Download and start first when the runtime has something else."""


class SetBreakpoints(Struct, frozen=True, rename="camel"):
    """Arguments of `setBreakpoints`: all breakpoints of one source."""

    source: Source
    breakpoints: list[SourceBreakpoint] = []


class DataBreakpoint(Struct, frozen=True, rename="camel"):
    """A wanted data breakpoint."""

    data_id: str
    access_type: str | None = None
    condition: str | None = None
    hit_condition: str | None = None


class SetDataBreakpoints(Struct, frozen=True):
    """Arguments of `setDataBreakpoints`: all of them."""

    breakpoints: list[DataBreakpoint] = []


class DataBreakpointInfo(Struct, frozen=True, rename="camel"):
    """Arguments of `dataBreakpointInfo`."""

    name: str
    variables_reference: int | None = None
    frame_id: int | None = None


class OfThread(Struct, frozen=True, rename="camel"):
    """Arguments of the commands that move a thread."""

    thread_id: int
    single_thread: bool = False


class StackTrace(Struct, frozen=True, rename="camel"):
    """Arguments of `stackTrace`."""

    thread_id: int
    start_frame: int = 0
    levels: int = 0


class OfFrame(Struct, frozen=True, rename="camel"):
    """Arguments of `scopes`."""

    frame_id: int


class Variables(Struct, frozen=True, rename="camel"):
    """Arguments of `variables`."""

    variables_reference: int
    start: int = 0
    count: int = 0


class SetVariable(Struct, frozen=True, rename="camel"):
    """Arguments of `setVariable`."""

    variables_reference: int
    name: str
    value: str


class Evaluate(Struct, frozen=True, rename="camel"):
    """Arguments of `evaluate`."""

    expression: str
    frame_id: int | None = None
    context: str | None = None


class SetExpression(Struct, frozen=True, rename="camel"):
    """Arguments of `setExpression`."""

    expression: str
    value: str
    frame_id: int | None = None


class GotoTargets(Struct, frozen=True, rename="camel"):
    """Arguments of `gotoTargets`."""

    source: Source
    line: int


class Goto(Struct, frozen=True, rename="camel"):
    """Arguments of `goto`."""

    thread_id: int
    target_id: int


class SourceText(Struct, frozen=True, rename="camel"):
    """Arguments of `source`."""

    source: Source | None = None
    source_reference: int = 0


class Disconnect(Struct, frozen=True, rename="camel"):
    """Arguments of `disconnect` and `terminate`."""

    restart: bool = False
    terminate_debuggee: bool | None = None


_REQUESTS = json.Decoder(Request)
_ENCODER = json.Encoder()


def read_request(text: str) -> Request | None:
    """A request as it has come; None for an answer of the client. Raises MessageError."""
    try:
        data = without_half_pairs(text)
        if json.decode(data, type=dict).get("type") == "response":
            return None
        return _REQUESTS.decode(data)
    except ValidationError as error:
        raise MessageError(
            f"A request is an object with seq, type: 'request' and command: {error}"
        ) from error
    except (DecodeError, UnicodeError, RecursionError) as error:
        raise MessageError(f"This is no JSON: {error}") from error


def arguments_as(kind: type[T], request: Request) -> T:
    """The arguments of a request. Raises MessageError that names the field that is wrong."""
    try:
        return json.decode(request.arguments, type=kind)
    except (DecodeError, RecursionError) as error:
        text = f"The arguments of '{request.command}' are not as they should be: {error}"
        raise MessageError(text) from error


def encode(message: dict[str, Any]) -> str:
    """A message as it is sent."""
    return _ENCODER.encode(message).decode()
