"""An application whose bodies the tests edit, built after every edit in one session and as a whole."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from compiled_programs import change_over
from linked_application import ApplicationFault, LoadedApplication, loaded

from tappet.codegen.build import BuildOptions, BuildResult, BuildSession, build_application
from tappet.codegen.package import CodePackage
from tappet.iec.task import Task
from tappet.lang.source import Source

OPTIONS = BuildOptions(level=1)
TASKS = (Task("T", programs=("PLC_PRG",)),)

OBJECTS = {
    "G": "VAR_GLOBAL {G} total : DINT; log : STRING(40); calls : INT; END_VAR",
    "I_Shape": "INTERFACE I_Shape\nMETHOD Area : DINT\nEND_METHOD\nEND_INTERFACE",
    "Scale": "FUNCTION Scale : DINT\nVAR_INPUT n : DINT; END_VAR\n{Scale}\nEND_FUNCTION",
    "Bump": "FUNCTION Bump : DINT\nVAR_IN_OUT f : FB_Base; END_VAR\n{Bump}\nEND_FUNCTION",
    "Unused": "FUNCTION Unused : DINT\nVAR_INPUT n : DINT; END_VAR\n{Unused}\nEND_FUNCTION",
    "FB_Base": (
        "FUNCTION_BLOCK FB_Base IMPLEMENTS I_Shape\nVAR_INPUT n : DINT := 2; END_VAR\n"
        "VAR i : DINT; row : ARRAY [0..3] OF DINT; {Base_vars} END_VAR\n{FB_Base}\nEND_FUNCTION_BLOCK"
    ),
    "FB_Base.Area": "METHOD Area : DINT\n{FB_Base.Area}\nEND_METHOD",
    "FB_Base.Where": "METHOD Where : POINTER TO DINT\n{FB_Base.Where}\nEND_METHOD",
    "FB_Base.Act": "ACTION Act\n{FB_Base.Act}\nEND_ACTION",
    "FB_Derived": (
        "FUNCTION_BLOCK FB_Derived EXTENDS FB_Base\nVAR inner : FB_Leaf; END_VAR\n{FB_Derived}\n"
        "END_FUNCTION_BLOCK"
    ),
    "FB_Derived.Area": "METHOD Area : DINT\n{FB_Derived.Area}\nEND_METHOD",
    "FB_Leaf": (
        "FUNCTION_BLOCK FB_Leaf\nVAR_OUTPUT q : DINT; END_VAR\nVAR t : TON; END_VAR\n"
        "PROPERTY Value : DINT\nGET\n{FB_Leaf.get}\nEND_GET\nEND_PROPERTY\n{FB_Leaf}\nEND_FUNCTION_BLOCK"
    ),
    "PLC_PRG": (
        "PROGRAM PLC_PRG\nVAR\n    b : FB_Base; d : FB_Derived; leaf : FB_Leaf; s : I_Shape;\n"
        "    p : POINTER TO DINT; pb : POINTER TO FB_Base; i : INT; sum : DINT; text : STRING(30);\n"
        "    x AT %MW4 : INT;\nEND_VAR\n"
        "s := d; pb := ADR(b); p := b.Where();\n{PLC_PRG}\nEND_PROGRAM"
    ),
}
"""Texts with places for what is edited."""

BODIES = {
    "Scale": [
        "Scale := 3 * n;",
        "Scale := n - G.calls;",
        "G.calls := G.calls + 1;\n\nScale := n;",
        "Scale := nn;",
    ],
    "Bump": ["f.n := f.n + 1;", "f.Act(); Bump := f.Area();", "Bump := Scale(f.n);"],
    "Unused": ["", "Unused := Scale(n);", "Unused := missing;"],
    "FB_Base": [
        "FOR i := 0 TO 3 DO row[i] := row[i] + n; END_FOR",
        "// moved\n\nFOR i := 0 TO 3 DO n := n + 1; row[i] := THIS^.Area(); END_FOR",
        "G.total := G.total + n; Act();",
        "n := n / (i - i);",
    ],
    "FB_Base.Area": [
        "Area := n;",
        "Area := Scale(n) + i;",
        "FOR i := 0 TO 2 DO Area := Area + row[i]; END_FOR",
    ],
    "FB_Base.Where": ["Where := ADR(n);", "Where := ADR(G.total);", "Where := ADR(row[1]);"],
    "FB_Base.Act": ["n := n + 1;", "G.log := 'base acts'; n := -n;", ""],
    "FB_Derived": ["inner(); SUPER^();", "n := 7; inner();", "{warning 'derived'}\nSUPER^();"],
    "FB_Derived.Area": ["Area := SUPER^.Area() + 10;", "Area := 5;", "Area := inner.Value;"],
    "FB_Leaf": [
        "q := q + 2;",
        "t(IN := TRUE, PT := T#10MS); q := q + BOOL_TO_DINT(t.Q);",
        "q := LEN(G.log);",
    ],
    "FB_Leaf.get": ["Value := q;", "Value := q * 2 + MAX(q, 3);"],
    "PLC_PRG": [
        "b(); d(); leaf(); sum := sum + s.Area();",
        "b(); FOR i := 0 TO 4 DO b.n := b.n + 1; p^ := p^ + 10; END_FOR",
        "FOR i := 0 TO 4 DO b.n := b.n + 1; pb^.Act(); sum := sum + pb^.Area(); END_FOR",
        "text := CONCAT(text, 'ab');\nG.log := text; sum := Bump(b) + Bump(d); leaf();",
        "p := ADR(sum); FOR i := 0 TO 4 DO sum := sum + 1; p^ := p^ * 2; END_FOR x := x + i;",
        "text := DINT_TO_STRING(sum); sum := sum + Scale(i); s := b; sum := sum + s.Area(); i := i + 1;",
        "IF __QUERYINTERFACE(s, s) THEN sum := sum + 100; END_IF\n%MW5000 := 3;",
        "sum := 'text';",
        "\n\nleaf(); sum := leaf.Value + leaf.q; d();",
    ],
    "G": ["", "more : INT := 4;"],
    "Base_vars": ["", "extra : DINT := 3;"],
}


def sources(bodies: dict[str, str]) -> list[Source]:
    found = []
    for name, text in OBJECTS.items():
        for part, body in bodies.items():
            text = text.replace(f"{{{part}}}", body)
        owner, _, child = name.partition(".")
        named = name if name == "G" else None
        found.append(Source(name, text, name=named, owner=owner if child else None))
    return found


def first() -> dict[str, str]:
    return {name: choices[0] for name, choices in BODIES.items()}


@dataclass
class Pair:
    """One application, built after every edit in one session and as a whole."""

    bodies: dict[str, str] = field(default_factory=first)
    session: BuildSession = field(default_factory=BuildSession)
    other: BuildSession = field(default_factory=BuildSession)
    """Keeps nothing but library texts and objects."""

    def build(self, previous: CodePackage | None = None, tasks: tuple[Task, ...] = TASKS) -> BuildResult:
        return build_application(sources(self.bodies), tasks, OPTIONS, previous, self.session)

    def whole(self, previous: CodePackage | None = None, tasks: tuple[Task, ...] = TASKS) -> BuildResult:
        self.other.analysis = self.other.generated = None
        return build_application(sources(self.bodies), tasks, OPTIONS, previous, self.other)

    def both(self, previous: CodePackage | None = None) -> tuple[BuildResult, BuildResult]:
        return self.build(previous), self.whole(previous)


def messages(result: BuildResult) -> list[str]:
    return [str(d) for d in result.diagnostics]


def faults(application: LoadedApplication, cycles: int = 3) -> list[object]:
    """The faults that end cycles, 6 ms apart."""
    found: list[object] = []
    for _ in range(cycles):
        try:
            application.cycle()
        except ApplicationFault as fault:
            found.append((fault.code, fault.args_abc))
        application.clock_ns += 6_000_000
    return found


def values(application: LoadedApplication, cycles: int = 3) -> list[object]:
    """What some cycles leave in the image; a fault ends one."""
    names = ["PLC_PRG.sum", "PLC_PRG.text", "PLC_PRG.i", "PLC_PRG.x", "G.total", "G.log", "G.calls"]
    for block in ("PLC_PRG.b", "PLC_PRG.d"):
        names += [f"{block}.n", f"{block}.i", f"{block}.row"]
    names += ["PLC_PRG.leaf.q", "PLC_PRG.d.inner.q"]
    return faults(application, cycles) + [application.read(name) for name in names]


def changed_over(
    old: CodePackage, new: CodePackage, run: Callable[[LoadedApplication, int], list[object]] = values
) -> list[object]:
    """Values after an online change in the third cycle; `run` takes cycles and gives what they leave."""
    with loaded(old) as application:
        run(application, 2)
        changed = change_over(application, new)
        try:
            return run(changed, 3)
        finally:
            changed.close()


def agree(pair: Pair, partial: bool = True, previous: CodePackage | None = None) -> BuildResult:
    """The next build of a pair, which gives what a whole one gives."""
    after, whole = pair.both(previous)
    assert messages(after) == messages(whole)
    assert after.package is not None
    assert whole.package is not None
    assert after.partial == partial
    assert after.package.code_id == whole.package.code_id
    with loaded(after.package) as a, loaded(whole.package) as b:
        assert values(a) == values(b)
    return after


def edited(pair: Pair, **bodies: str) -> Pair:
    pair.bodies |= {name.replace("__", "."): body for name, body in bodies.items()}
    return pair
