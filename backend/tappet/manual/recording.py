"""Runs the examples on virtual time, all of them in one build, and records what they show.

Each example starts with fresh axes: the application is reset before it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from tappet.codegen.build import BuildOptions, BuildSession, LibraryReference, build_application
from tappet.codegen.package import CodePackage
from tappet.codegen.values import Value
from tappet.iec.task import Task
from tappet.lang.diagnostics import Diagnostic
from tappet.lang.source import Source
from tappet.libraries import load
from tappet.libraries.catalog import Item, items
from tappet.manual.examples import AXES, CYCLE_MS, Example
from tappet.runtime.flight import FlightSettings
from tappet.runtime.local import LocalRuntime

LIBRARIES = ("SM3_Basic", "SM3_CamBuilder", "SM3_CNC")
NS_PER_MS = 1_000_000
TOLERANCE = 1e-6
_CYCLE = """PROGRAM Cycle
VAR
    iExample : INT;
END_VAR
{begin}
CASE iExample OF
{calls}
END_CASE
{end}
END_PROGRAM
"""
_LIMITS = "fMaxVelocity := 1000.0, fMaxAcceleration := 10000.0, fMaxDeceleration := 10000.0"
_TYPES = {"linear": "iMovementType := 1", "rotary": "iMovementType := 0, fPositionPeriod := 360.0"}
HANDSHAKE = re.compile(
    r"b?(Execute|Enable|Busy|Active|Done|CommandAborted|Error|Valid|Status|In[A-Z]\w*|StartSync|EndOfProfile|JogForward"
    r"|JogBackward|InchForward|InchBackward)"
)
"""Pins that are drawn even if they do not change."""


class ExampleError(ValueError):
    """The examples do not compile without a message, or one does not run to its end."""


@dataclass(frozen=True, slots=True)
class Recording:
    """What an example has shown, one value a cycle."""

    example: Example
    traces: Mapping[str, tuple[Value, ...]]
    """By expression as the example writes it."""
    literals: tuple[str, ...]
    """What is expected as it came."""
    states: tuple[frozenset[int], ...]
    """Numbers of the states of its axes, one set an axis."""

    @property
    def wrong(self) -> list[str]:
        """Expectations that did not come true."""
        return [
            f"{self.example.name}, cycle {one.cycle}: {one.expression} is {literal}, not {one.value}"
            for one, literal in zip(self.example.expectations, self.literals, strict=True)
            if not _same(literal, one.value)
        ]


def frame() -> str:
    """The axes of the examples, as the tree of a project declares them."""
    lines = [
        f"    {name} : AXIS_REF_VIRTUAL_SM3 := ({_TYPES[kind]}, {_LIMITS});" for name, kind in AXES.items()
    ]
    return "\n".join(["VAR_GLOBAL", *lines, "END_VAR"])


def record(examples: Mapping[str, Example]) -> Iterator[Recording]:
    """Runs all examples; raises ExampleError."""
    if not examples:
        return
    package = _built(tuple(examples.values()))
    blocks = {item.name: item for name in LIBRARIES for item in items(load(name))}
    with LocalRuntime(package, flight=FlightSettings(memory=0), start=False) as runtime:
        for number, example in enumerate(examples.values()):
            yield _recorded(runtime, number, example, blocks[example.name])


def _built(examples: tuple[Example, ...]) -> CodePackage:
    sources = [Source(f"{example.name}.st", example.program, name=example.pou) for example in examples]
    calls = "\n".join(f"{number}: {example.pou}();" for number, example in enumerate(examples))
    begin = "\n".join(f"{axis}.fTaskCycle := {CYCLE_MS / 1000};\n{axis}.BeginCycle();" for axis in AXES)
    end = "\n".join(f"{axis}.EndCycle();" for axis in AXES)
    cycle = _CYCLE.format(begin=begin, calls=calls, end=end)
    sources += [Source("Axes", frame(), name="Axes"), Source("Cycle", cycle, name="Cycle")]
    task = Task("Bus", interval_ns=CYCLE_MS * NS_PER_MS, programs=("Cycle",))
    references = tuple(LibraryReference(name) for name in (*LIBRARIES, "Standard"))
    options = BuildOptions(libraries=references, level=1)
    result = build_application(sources, [task], options=options, session=BuildSession())
    messages = [str(one) for one in result.diagnostics if _counts(one)]
    if messages or result.package is None:
        raise ExampleError("\n".join(messages))
    return result.package


def _counts(diagnostic: Diagnostic) -> bool:
    return diagnostic.severity in ("error", "warning")


def _recorded(runtime: LocalRuntime, number: int, example: Example, block: Item) -> Recording:
    shown = example.chart or _offered(example, block)
    states = [f"{axis}.nAxisState" for axis in example.axes]
    wanted = dict.fromkeys([*shown, *states, *(one.expression for one in example.expectations)])
    paths = {expression: _path(runtime, example, expression) for expression in wanted}
    runtime.reset("cold")
    runtime.write("Cycle.iExample", number)
    trace = runtime.trace(sorted(set(paths.values())))
    runtime.start()
    runtime.run(example.cycles)
    runtime.stop()
    samples = trace.samples
    trace.close()
    if len(samples) != example.cycles:
        raise ExampleError(f"{example.name}: {len(samples)} cycles were recorded")
    values = {
        expression: tuple(sample.values[path] for sample in samples) for expression, path in paths.items()
    }
    symbols = runtime.package.symbols
    literals = tuple(
        symbols.format_literal(symbols.resolve(paths[one.expression]), values[one.expression][one.cycle - 1])
        for one in example.expectations
    )
    return Recording(
        example,
        {expression: values[expression] for expression in shown},
        literals,
        tuple(frozenset(int(str(value)) for value in values[state]) for state in states),
    )


def _offered(example: Example, block: Item) -> tuple[str, ...]:
    """The BOOL pins of the block, and the state and set values of the axes."""
    pins = [pin.name for pin in (*block.inputs, *block.outputs) if pin.type == "BOOL"]
    shown = [f"{example.instance}.{pin}" for pin in pins] if example.instance else []
    for axis in example.axes:
        shown += [f"{axis}.{member}" for member in ("nAxisState", "fSetPosition", "fSetVelocity")]
    return tuple(shown)


def _path(runtime: LocalRuntime, example: Example, expression: str) -> str:
    """Global where it begins with an axis, else of the program."""
    head = re.split(r"[.\[]", expression)[0]
    return f"Axes.{expression}" if head in AXES else f"{example.pou}.{expression}"


def _same(found: str, expected: str) -> bool:
    try:
        return abs(float(found) - float(expected)) <= TOLERANCE * max(1.0, abs(float(expected)))
    except ValueError:
        return found == expected
