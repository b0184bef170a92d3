"""A random chart: steps, transitions and actions, small enough to be walked by `chart_reference`."""

from __future__ import annotations

from dataclasses import dataclass, field

CYCLE_MS = 10
"""Time between two calls."""


@dataclass(frozen=True)
class Condition:
    """`op` over operands: a bit of the input, a flag by path, the age of a step, NOT, AND, OR, Ask."""

    op: str
    operands: tuple[Condition, ...] = ()
    name: str = ""
    number: int = 0

    def text(self) -> str:
        if self.op == "bit":
            return f"r.{self.number}"
        if self.op == "flag":
            return self.name
        if self.op == "age":
            return f"{self.name}.t >= T#{self.number}ms"
        if self.op == "rest":
            return f"n MOD {self.number} = 1"
        inner = [f"({c.text()})" for c in self.operands]
        if self.op == "Ask":
            return f"Ask(asked, {self.number}, {inner[0]})"
        return f"NOT {inner[0]}" if self.op == "NOT" else f" {self.op} ".join(inner)


@dataclass(frozen=True)
class Association:
    """An action or BOOL variable at a step."""

    action: str
    qualifier: str
    time: int = -1
    """Milliseconds; -1 without."""


@dataclass
class Step:
    """A step with its associations and its own actions by role: STEP, ENTRY, EXIT."""

    name: str
    associations: list[Association] = field(default_factory=list)
    roles: dict[str, str] = field(default_factory=dict)
    minimum: int = -1
    maximum: int = -1


@dataclass(frozen=True)
class Transition:
    """From steps that must all be active to steps that become active together."""

    sources: tuple[str, ...]
    targets: tuple[str, ...]
    condition: Condition
    priority: int = 0
    """0 without."""


@dataclass
class Chart:
    """The first step is the initial one. Each action adds its number to the log of what was executed."""

    steps: list[Step] = field(default_factory=list)
    transitions: list[Transition] = field(default_factory=list)
    actions: dict[str, int] = field(default_factory=dict)
    flags: list[str] = field(default_factory=list)
    """BOOL variables that stand as actions."""
    inputs: dict[str, tuple[int, int]] = field(default_factory=dict)
    """SFC flags that are inputs: TRUE where the input has both of these bits."""
    outputs: list[str] = field(default_factory=list)
    """SFC flags that are only watched: SFCTrans, SFCCurrentStep, SFCError, SFCErrorStep."""


def text(chart: Chart, name: str) -> str:
    """The function block."""
    own = ["log : UDINT;", "n : INT;", "asked : ARRAY[0..7] OF INT;", *(f"{f} : BOOL;" for f in chart.flags)]
    own += [f"{f} : {'STRING' if f in TEXTS else 'BOOL'};" for f in chart.outputs]
    given = ["r : UDINT;", *(f"{f} : BOOL;" for f in chart.inputs)]
    lines = [f"FUNCTION_BLOCK {name}", "VAR_INPUT", *given, "END_VAR", "VAR", *own, "END_VAR"]
    for number, step in enumerate(chart.steps):
        lines.append(f"{'STEP' if number else 'INITIAL_STEP'} {step.name}:")
        lines += [f"    {a.action}({a.qualifier}{_time(a)});" for a in step.associations]
        lines += [f"    {action}({role});" for role, action in step.roles.items()]
        lines += [f"    MIN_TIME := T#{step.minimum}ms;"] if step.minimum >= 0 else []
        lines += [f"    MAX_TIME := T#{step.maximum}ms;"] if step.maximum >= 0 else []
        lines.append("END_STEP")
    for t in chart.transitions:
        sources, targets = (_several(names) for names in (t.sources, t.targets))
        priority = f" (PRIORITY := {t.priority})" if t.priority else ""
        lines.append(f"TRANSITION{priority} FROM {sources} TO {targets}")
        lines += [f"    := {t.condition.text()};", "END_TRANSITION"]
    for action, number in chart.actions.items():
        lines.append(f"ACTION {action}: log := log * 31 + {number}; n := n + 1; END_ACTION")
    return "\n".join([*lines, "END_FUNCTION_BLOCK"])


def _time(a: Association) -> str:
    return f", T#{a.time}ms" if a.time >= 0 else ""


def _several(names: tuple[str, ...]) -> str:
    return names[0] if len(names) == 1 else f"({', '.join(names)})"


TEXTS = ("SFCCurrentStep", "SFCErrorStep")
ASK = """FUNCTION Ask : BOOL
VAR_IN_OUT asked : ARRAY[0..7] OF INT; END_VAR
VAR_INPUT place : INT; answer : BOOL; END_VAR
asked[place] := asked[place] + 1;
Ask := answer;
END_FUNCTION"""
