"""Random edits of the declarations of a program that runs, and a plain model of the values it then has.

The model knows nothing of layouts, types of the compiler or plans of changes: a program is a tree of named
variables, a value belongs to a path, and it stays as long as the path leads to something that can hold it.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from random import Random
from typing import Any

INTEGERS = {
    "SINT": (-(1 << 7), (1 << 7) - 1), "INT": (-(1 << 15), (1 << 15) - 1),
    "DINT": (-(1 << 31), (1 << 31) - 1), "LINT": (-(1 << 63), (1 << 63) - 1),
    "USINT": (0, (1 << 8) - 1), "UINT": (0, (1 << 16) - 1), "UDINT": (0, (1 << 32) - 1),
    "ULINT": (0, (1 << 64) - 1), "BYTE": (0, (1 << 8) - 1), "WORD": (0, (1 << 16) - 1),
    "DWORD": (0, (1 << 32) - 1), "LWORD": (0, (1 << 64) - 1),
}  # fmt: skip
NUMBERS = (*INTEGERS, "BOOL", "REAL", "LREAL")
UDINT_MAX = (1 << 32) - 1
BORN = 77
"""What FB_Init writes."""


@dataclass(frozen=True)
class Text:
    length: int

    def __str__(self) -> str:
        return f"STRING({self.length})"


@dataclass(frozen=True)
class Array:
    element: Type
    bounds: tuple[tuple[int, int], ...]

    def __str__(self) -> str:
        return f"ARRAY [{', '.join(f'{low}..{high}' for low, high in self.bounds)}] OF {self.element}"


@dataclass(frozen=True)
class Named:
    """A structure or function block of the program."""

    name: str

    def __str__(self) -> str:
        return self.name


Type = str | Text | Array | Named


@dataclass(frozen=True)
class Variable:
    name: str
    type: Type
    initial: Any = None
    remanent: bool = False


@dataclass
class Block:
    base: str | None
    variables: list[Variable]
    step: int
    init: bool


@dataclass
class Program:
    structs: dict[str, list[Variable]] = field(default_factory=dict)
    blocks: dict[str, Block] = field(default_factory=dict)
    programs: dict[str, list[Variable]] = field(default_factory=dict)
    lists: dict[str, list[Variable]] = field(default_factory=dict)
    step: int = 1
    order: list[str] = field(default_factory=list)
    """Programs in the order in which the task calls them."""

    def line(self, name: str) -> list[tuple[str, Block]]:
        """A block behind its bases."""
        block = self.blocks[name]
        return [*(self.line(block.base) if block.base else []), (name, block)]


@dataclass(frozen=True)
class Leaf:
    """A variable with a value of its own."""

    type: str | Text
    initial: Any
    within: tuple[str, ...]
    """What holds it, from the outside: a program, list, structure, block or array."""


def leaves(program: Program) -> dict[str, Leaf]:
    """All values by their paths."""
    found: dict[str, Leaf] = {}
    for kind, owners in (("program", program.programs), ("list", program.lists)):
        for owner, variables in owners.items():
            found |= dict(_of_variables(program, owner, variables, (kind,)))
    for name in program.programs:
        found[f"{name}.nRun"] = Leaf("UDINT", 0, ("program",))
    return found


def _of_variables(
    program: Program, path: str, variables: list[Variable], within: tuple[str, ...]
) -> Iterator[tuple[str, Leaf]]:
    for v in variables:
        yield from _of_type(program, f"{path}.{v.name}", v.type, v.initial, within)


def _of_type(
    program: Program, path: str, type_: Type, initial: Any, within: tuple[str, ...]
) -> Iterator[tuple[str, Leaf]]:
    if isinstance(type_, Array):
        for index in _indices(type_.bounds):
            place = f"{path}[{', '.join(map(str, index))}]"
            yield from _of_type(program, place, type_.element, initial, (*within, f"array{len(index)}"))
    elif isinstance(type_, Named) and type_.name in program.structs:
        yield from _of_variables(program, path, program.structs[type_.name], (*within, "struct"))
    elif isinstance(type_, Named):
        inner = (*within, "block")
        for name, block in program.line(type_.name):
            yield from _of_variables(program, path, block.variables, inner)
            yield f"{path}.born_{name}", Leaf("UDINT", BORN if block.init else 0, inner)
            yield f"{path}.n_{name}", Leaf("UDINT", 0, inner)
    else:
        default: Any = "" if isinstance(type_, Text) else False if type_ == "BOOL" else 0
        yield path, Leaf(type_, default if initial is None else initial, within)


def _indices(bounds: tuple[tuple[int, int], ...]) -> Iterator[tuple[int, ...]]:
    if not bounds:
        yield ()
        return
    low, high = bounds[0]
    for first in range(low, high + 1):
        for rest in _indices(bounds[1:]):
            yield (first, *rest)


def after_change(old: Program, values: dict[str, Any], new: Program) -> dict[str, Any]:
    """The values of the new program: each path keeps its value where it still can hold it."""
    before, result = leaves(old), {}
    for path, leaf in leaves(new).items():
        known = before.get(path)
        if known is None or known.within != leaf.within:
            result[path] = leaf.initial
        else:
            result[path] = _converted(known.type, values[path], leaf)
    return result


def _converted(old: str | Text, value: Any, leaf: Leaf) -> Any:
    new = leaf.type
    if isinstance(old, Text) or isinstance(new, Text):
        both = isinstance(old, Text) and isinstance(new, Text)
        return value[: new.length] if both and isinstance(new, Text) else leaf.initial
    if old == new:
        return value
    if new == "LREAL" or (new == "REAL" and old == "LREAL"):
        number = float(value)
        if old not in ("REAL", "LREAL") and number != value:
            return leaf.initial  # a whole number with more digits than the type has
        return number if new == "LREAL" else _as_real(number, leaf.initial)
    if new == "REAL":
        number = _as_real(float(value), None)
        return number if number is not None and number == value else leaf.initial
    low, high = (0, 1) if new == "BOOL" else INTEGERS[new]
    if value != int(value) or not low <= value <= high:
        return leaf.initial
    return bool(value) if new == "BOOL" else int(value)


def _as_real(value: float, otherwise: Any) -> Any:
    try:
        return struct.unpack("<f", struct.pack("<f", value))[0]
    except OverflowError:
        return otherwise


def run_cycle(program: Program, values: dict[str, Any]) -> None:
    """What one cycle does: programs count, and the blocks that stand in them as such."""
    for name in program.order:
        values[f"{name}.nRun"] = (values[f"{name}.nRun"] + program.step) & UDINT_MAX
        for v in program.programs[name]:
            if isinstance(v.type, Named) and v.type.name in program.blocks:
                for block_name, block in program.line(v.type.name):
                    path = f"{name}.{v.name}.n_{block_name}"
                    values[path] = (values[path] + block.step) & UDINT_MAX


# -- texts ------------------------------------------------------------------------------------------


def objects(program: Program) -> dict[str, str]:
    """Texts of the objects by name."""
    found = {}
    for name, members in program.structs.items():
        found[name] = f"TYPE {name} : STRUCT\n{_declared(members)}END_STRUCT END_TYPE"
    for name, block in program.blocks.items():
        head = f"FUNCTION_BLOCK {name}" + (f" EXTENDS {block.base}" if block.base else "")
        own = f"born_{name} : UDINT; n_{name} : UDINT;\n"
        body = f"n_{name} := n_{name} + {block.step};\n"
        above = "SUPER^.Tick();\n" if block.base else ""
        init = (
            "METHOD FB_Init : BOOL\nVAR_INPUT bInitRetains : BOOL; bInCopyCode : BOOL; END_VAR\n"
            f"born_{name} := {BORN};\nEND_METHOD\n"
        )
        found[name] = (
            f"{head}\nVAR\n{_declared(block.variables)}{own}END_VAR\n"
            f"METHOD Tick : BOOL\n{above}{body}END_METHOD\n"
            f"{init if block.init else ''}END_FUNCTION_BLOCK"
        )
    for name, variables in program.lists.items():
        found[name] = "\n".join(_sections("VAR_GLOBAL", variables)) or "VAR_GLOBAL\nEND_VAR"
    for name, variables in program.programs.items():
        calls = "".join(
            f"{v.name}.Tick();\n"
            for v in variables
            if isinstance(v.type, Named) and v.type.name in program.blocks
        )
        mine = "VAR\nnRun : UDINT; pRun : POINTER TO UDINT; bFollows : BOOL;\nEND_VAR"
        first, rest = variables[: len(variables) // 2], variables[len(variables) // 2 :]
        sections = "\n".join([*_sections("VAR", first), mine, *_sections("VAR", rest)])
        found[name] = (
            f"PROGRAM {name}\n{sections}\n"
            "IF pRun = 0 THEN pRun := ADR(nRun); END_IF\nbFollows := pRun = ADR(nRun);\n"
            f"nRun := nRun + {program.step};\n{calls}END_PROGRAM"
        )
    return found


def _sections(word: str, variables: list[Variable]) -> Iterator[str]:
    """Runs of variables of one kind, so that the order stays."""
    run: list[Variable] = []
    for v in [*variables, None]:
        if run and (v is None or v.remanent != run[0].remanent):
            yield f"{word}{' RETAIN' if run[0].remanent else ''}\n{_declared(run)}END_VAR"
            run = []
        if v is not None:
            run.append(v)


def _declared(variables: list[Variable]) -> str:
    return "".join(f"    {v.name} : {v.type}{_initial(v)};\n" for v in variables)


def _initial(v: Variable) -> str:
    if v.initial is None:
        return ""
    if isinstance(v.type, Array):
        count = len(list(_indices(v.type.bounds)))
        return f" := [{count}({_literal(v.type.element, v.initial)})]"
    return f" := {_literal(v.type, v.initial)}"


def _literal(type_: Type, value: Any) -> str:
    if isinstance(type_, Text):
        return f"'{value}'"
    if type_ == "BOOL":
        return "TRUE" if value else "FALSE"
    return f"{type_}#{value}"


# -- edits ------------------------------------------------------------------------------------------


class Maker:
    """Makes programs, edits and values."""

    def __init__(self, r: Random) -> None:
        self.r = r
        self.made = 0

    def fresh(self, prefix: str) -> str:
        self.made += 1
        return f"{prefix}{self.made}"

    def program(self) -> Program:
        p = Program(order=["PLC_PRG", "Aux"])
        for _ in range(2):
            p.structs[self.fresh("S_")] = [self.variable(p, blocks=False) for _ in range(3)]
        for _ in range(3):
            self.add_block(p)
        for name in p.order:
            p.programs[name] = [self.variable(p) for _ in range(6)]
        for _ in range(2):
            p.lists[self.fresh("G_")] = [self.variable(p) for _ in range(4)]
        return p

    def scalar(self) -> str | Text:
        return Text(self.r.randint(1, 20)) if self.r.random() < 0.15 else self.r.choice(NUMBERS)

    def value(self, type_: str | Text) -> Any:
        r = self.r
        if isinstance(type_, Text):
            return "".join(r.choice("abcXYZ 019") for _ in range(r.randint(0, type_.length)))
        if type_ == "BOOL":
            return r.random() < 0.5
        if type_ in ("REAL", "LREAL"):
            number = r.choice((float(r.randint(-300, 70_000)), r.uniform(-1e3, 1e3), r.uniform(-1e30, 1e30)))
            return _as_real(number, 0.0) if type_ == "REAL" else number
        low, high = INTEGERS[type_]
        few = [n for n in (r.randint(-200, 300), r.randint(0, 40_000)) if low <= n <= high]
        return r.choice([*few, low, high, r.randint(low, high)])

    def type(self, program: Program, *, blocks: bool = True) -> Type:
        r, kind = self.r, self.r.random()
        if kind < 0.55:
            return self.scalar()
        if kind < 0.75:
            lows = [r.randint(-2, 2) for _ in range(r.choice((1, 1, 2)))]
            bounds = tuple((low, low + r.randint(0, 3)) for low in lows)
            element = self.type(program, blocks=blocks)
            return Array(element if not isinstance(element, Array) else self.scalar(), bounds)
        names = [*program.structs, *(program.blocks if blocks else ())]
        return Named(r.choice(names)) if names else self.scalar()

    def variable(self, program: Program, *, blocks: bool = True) -> Variable:
        return self.initialised(Variable(self.fresh("v"), self.type(program, blocks=blocks)))

    def initialised(self, v: Variable) -> Variable:
        """The variable with another initial value, if its type can have one."""
        simple = v.type.element if isinstance(v.type, Array) else v.type
        if isinstance(simple, Array | Named) or self.r.random() < 0.4:
            return replace(v, initial=None)
        value = self.value(simple)
        if isinstance(value, float):
            value = float(self.r.randint(-1000, 1000)) / 8
        return replace(v, initial=value)

    def add_block(self, p: Program) -> None:
        base = self.r.choice([None, *p.blocks])
        name = self.fresh("FB_")
        variables = [self.variable(p) for _ in range(self.r.randint(1, 3))]
        p.blocks[name] = Block(base, variables, self.r.randint(1, 9), self.r.random() < 0.4)

    def edited(self, old: Program) -> Program:
        """The program after one to three edits."""
        p = Program(
            {name: list(members) for name, members in old.structs.items()},
            {name: replace(block, variables=list(block.variables)) for name, block in old.blocks.items()},
            {name: list(variables) for name, variables in old.programs.items()},
            {name: list(variables) for name, variables in old.lists.items()},
            old.step,
            list(old.order),
        )
        for _ in range(self.r.randint(1, 3)):
            self.edit(p)
        return p

    def edit(self, p: Program) -> None:
        r = self.r
        kind = r.random()
        if kind < 0.1:
            p.step = r.randint(1, 1000)
        elif kind < 0.15:
            r.shuffle(p.order)
        elif kind < 0.25:
            block = p.blocks[r.choice(list(p.blocks))]
            block.step = r.randint(1, 99)
        elif kind < 0.3:
            block = p.blocks[r.choice(list(p.blocks))]
            block.init = not block.init
        elif kind < 0.36:
            self.rebase(p)
        elif kind < 0.4:
            self.add_block(p)
        elif kind < 0.43:
            p.lists[self.fresh("G_")] = [self.variable(p)]
        elif kind < 0.46 and len(p.lists) > 1:
            del p.lists[r.choice(list(p.lists))]
        else:
            self.edit_variables(p)

    def rebase(self, p: Program) -> None:
        """Another base, or none: of the blocks that were there before, so that no circle comes about."""
        names = list(p.blocks)
        name = r_name = self.r.choice(names)
        block, before = p.blocks[name], names[: names.index(r_name)]
        block.base = self.r.choice([None, *before])

    def edit_variables(self, p: Program) -> None:
        r = self.r
        place = r.random()
        variables: list[Variable]
        blocks = True
        known = p
        if place < 0.2:
            variables, blocks = p.structs[r.choice(list(p.structs))], False
            known = Program()  # members of other structures could contain each other
        elif place < 0.45:
            name = r.choice(list(p.blocks))
            variables = p.blocks[name].variables
            before = list(p.blocks)[: list(p.blocks).index(name)]
            known = Program(p.structs, {n: p.blocks[n] for n in before})
        elif place < 0.8:
            variables = p.programs[r.choice(p.order)]
        else:
            variables = p.lists[r.choice(list(p.lists))]
        act = r.random()
        if not variables or act < 0.25:
            variables.insert(r.randint(0, len(variables)), self.variable(known, blocks=blocks))
            return
        at = r.randrange(len(variables))
        v = variables[at]
        if act < 0.4:
            if len(variables) > 1:
                variables.pop(at)
        elif act < 0.5:
            variables[at] = replace(v, name=self.fresh("v"))
        elif act < 0.7:
            variables[at] = self.initialised(replace(v, type=self.retyped(v.type, known, blocks)))
        elif act < 0.8:
            variables[at] = self.initialised(v)
        elif act < 0.9:
            r.shuffle(variables)
        elif blocks and known is p:
            variables[at] = replace(v, remanent=not v.remanent)

    def retyped(self, type_: Type, known: Program, blocks: bool) -> Type:
        r = self.r
        if isinstance(type_, Array) and r.random() < 0.7:
            if r.random() < 0.5:
                moved = ((low + r.randint(-1, 1), high) for low, high in type_.bounds)
                return replace(
                    type_, bounds=tuple((min(low, high), high + r.randint(0, 2)) for low, high in moved)
                )
            element = self.retyped(type_.element, known, blocks)
            return replace(type_, element=element if not isinstance(element, Array) else self.scalar())
        if isinstance(type_, str) and r.random() < 0.8:
            return r.choice(NUMBERS)
        return self.type(known, blocks=blocks)
