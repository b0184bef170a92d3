"""What clients of the debugger send and get: places, breakpoints, halts, frames and variables."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, Literal

from msgspec import Meta, Struct

Name = Annotated[str, Meta(max_length=1000)]
LineNumber = Annotated[int, Meta(ge=1, le=1 << 30)]
Reason = Literal["breakpoint", "step", "pause", "data", "run_to"]
Outputs = Literal["keep", "safe"]
Command = Literal[
    "continue", "pause", "step_into", "step_over", "step_out", "run_to", "next_statement", "single_cycle"
]
Scope = Literal["local", "this"]
OtherTasks = Literal["run", "halt"]


class Spot(Struct, frozen=True):
    """A line or a drawn element where somebody wants to halt."""

    object_id: Annotated[Name, Meta(description="Object of the project; the uri of a text without project.")]
    line: Annotated[LineNumber | None, Meta(description="From 1, as the editor counts.")] = None
    element: Annotated[Name | None, Meta(description="Id of an element of a drawn part.")] = None
    part: Annotated[Name, Meta(description="Empty for a text without project.")] = "implementation"


class CodeSpot(Struct, frozen=True):
    """Where the program is. Object and part are known for what was built from a project."""

    pou: str
    uri: str
    line: Annotated[int, Meta(description="From 1: in the part, or in the text where no part is known.")]
    end_line: int
    object_id: str | None = None
    part: str | None = None
    element: Annotated[str | None, Meta(description="Id of the element in a drawn part.")] = None


class Hits(Struct, frozen=True):
    """At which of the passes that fulfil its conditions a breakpoint acts."""

    mode: Literal["always", "equal", "from", "every"] = "always"
    count: Annotated[int, Meta(ge=1, le=1 << 48)] = 1


class BreakpointOrder(Struct, frozen=True):
    """A breakpoint as somebody wants it."""

    kind: Literal["line", "data"] = "line"
    place: Spot | None = None
    expression: Annotated[Name | None, Meta(description="Path of the variable of a data breakpoint.")] = None
    condition: Annotated[
        Name | None, Meta(description="Expression of what is visible there: only where it holds.")
    ] = None
    hits: Hits = Hits()
    instance: Annotated[Name | None, Meta(description="Path of the only function block instance meant.")] = (
        None
    )
    task: Annotated[Name | None, Meta(description="The only task meant.")] = None
    log: Annotated[
        Name | None,
        Meta(description="Text for the log instead of a halt, with {expressions}; {{ and }} are braces."),
    ] = None
    enabled: bool = True
    kept: Annotated[
        bool,
        Meta(description="Outlives the runtime's process; false where a client sets it again."),
    ] = True


class Breakpoint(Struct, frozen=True):
    """A breakpoint and what became of it."""

    SENTENCES: ClassVar = ("reason",)

    id: int
    order: BreakpointOrder
    verified: bool
    reason: Annotated[str | None, Meta(description="Why it is not verified.")]
    hit_count: int
    actual: Annotated[CodeSpot | None, Meta(description="The next place where the program can halt.")]


class Settings(Struct, frozen=True):
    """What happens around a halted task."""

    outputs: Annotated[Outputs, Meta(description="`safe`: all outputs are zero while a task is halted.")] = (
        "keep"
    )
    other_tasks: Annotated[OtherTasks, Meta(description="`halt`: they halt at their next statement.")] = "run"


class Halt(Struct, frozen=True):
    """A task that stands at a statement."""

    SENTENCES: ClassVar = ("message",)

    task: str
    cycle: int
    reason: Reason
    place: CodeSpot
    breakpoint_id: int | None = None
    instance: Annotated[str | None, Meta(description="Path of the function block instance.")] = None
    message: str | None = None


class DebugState(Struct, frozen=True):
    """What the debugger does."""

    available: Annotated[bool, Meta(description="The instrumented variant of the application is loaded.")]
    active: Annotated[bool, Meta(description="Tasks run the instrumented variant.")]
    sequence: Annotated[int, Meta(description="Grows with every change of this state.")]
    settings: Settings
    halted: list[Halt]
    breakpoints: list[Breakpoint]


class Frame(Struct, frozen=True):
    """One level of the call stack."""

    index: Annotated[int, Meta(description="0 is the innermost.")]
    place: CodeSpot
    instance: str | None


class Stack(Struct, frozen=True):
    """The call stack of a task."""

    task: str
    cycle: int
    frames: list[Frame]


class Variable(Struct, frozen=True):
    """A variable of a frame."""

    name: str
    type: str
    kind: str
    section: str
    value: Annotated[Any, Meta(description="JSON value; null when it cannot be read.")]
    literal: Annotated[str, Meta(description="IEC literal; empty for structures and arrays.")]
    text: Annotated[
        str, Meta(description="The literal; structures and arrays as an initial value has them, shortened.")
    ]
    writable: bool
    scope: Scope
    path: Annotated[str | None, Meta(description="By which it can be monitored as any other.")] = None


class Variables(Struct, frozen=True):
    """All variables of a frame."""

    variables: list[Variable]


class FlowValue(Struct, frozen=True):
    """A variable that a statement names, right after it."""

    name: str
    literal: str


class FlowStatement(Struct, frozen=True):
    """A statement that was executed."""

    line: int
    end_line: Annotated[int, Meta(description="Of one with statements inside: of its head.")]
    element: str | None
    part: str | None
    count: Annotated[int, Meta(description="How often, in this cycle.")]
    values: Annotated[list[FlowValue], Meta(description="After its last execution.")]


class FlowSnapshot(Struct, frozen=True):
    """What one cycle has executed of an object."""

    object_id: str
    cycle: Annotated[int, Meta(description="0: no cycle is complete yet.")]
    statements: list[FlowStatement]
