"""A plain model of small ST programs: their text, and the statements that one cycle passes, in order.

Each event is (line, activations): the functions that are running, the innermost last, by numbers that are
given out one by one. The rules of steps follow from the events alone, see `steps`.
"""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

Event = tuple[int, tuple[int, ...]]
Node = tuple[Any, ...]


class _Return(Exception):  # noqa: N818 - flow of control
    pass


class _Exit(Exception):  # noqa: N818
    pass


class _Continue(Exception):  # noqa: N818
    pass


@dataclass
class Body:
    """A function, or the program."""

    name: str
    variables: list[str]
    statements: list[Node] = field(default_factory=list)


class Program:
    """A random program: three functions that call the ones before them, a block, and PLC_PRG."""

    def __init__(self, seed: int, size: int = 5) -> None:
        self.random = random.Random(seed)
        self.lines: list[str] = []
        self.functions: list[Body] = []
        for number in range(3):
            body = Body(f"F{number}", ["a", "b", "x", "y", f"F{number}"])
            self._head(f"FUNCTION {body.name} : DINT", ["a", "b"], ["x", "y", *_counters()])
            self._statements(body, body.statements, size, 0, 0)
            self.lines.append("END_FUNCTION")
            self.functions.append(body)
        self.block = Body("FB_One", ["a", "x", "y"])
        self._head("FUNCTION_BLOCK FB_One", ["a"], ["x", "y", *_counters()])
        self._statements(self.block, self.block.statements, size, 0, 0)
        self.lines.append("END_FUNCTION_BLOCK")
        self.main = Body("PLC_PRG", ["x", "y", "z"])
        self._head("PROGRAM PLC_PRG", [], ["x", "y", "z", *_counters()], "one : FB_One; two : FB_One;")
        self._statements(self.main, self.main.statements, size + 2, 0, 0)
        self.lines.append("END_PROGRAM")
        self.text = "\n".join(self.lines) + "\n"
        self.memory: dict[str, dict[str, int]] = {}
        self._activations = 0

    # -- text ----------------------------------------------------------------------------------------

    def _head(self, first: str, inputs: list[str], variables: list[str], more: str = "") -> None:
        self.lines.append(first)
        if inputs:
            self.lines += ["VAR_INPUT", f"    {', '.join(inputs)} : DINT;", "END_VAR"]
        self.lines += ["VAR", f"    {', '.join(variables)} : DINT;"]
        self.lines += [f"    {more}"] if more else []
        self.lines.append("END_VAR")

    def _add(self, indent: int, text: str) -> int:
        self.lines.append("    " * indent + text)
        return len(self.lines)

    def _expression(self, body: Body) -> Node:
        if self.random.random() < 0.4:
            return ("const", self.random.randint(0, 9))
        if self.random.random() < 0.6:
            return ("var", self.random.choice(body.variables))
        op = self.random.choice("+*")
        return (op, self._expression(body), self._expression(body))

    def _statements(self, body: Body, into: list[Node], size: int, depth: int, loops: int) -> None:
        into += [self._statement(body, depth, loops) for _ in range(self.random.randint(1, size))]

    def _statement(self, body: Body, depth: int, loops: int) -> Node:
        deep = depth >= 2
        kinds = ["assign"] * 3 + ["call"] * 2 + ([] if deep else ["if", "for", "while", "repeat", "case"])
        kinds += ["return"] if depth and self.random.random() < 0.3 else []
        kinds += ["exit", "continue"] if loops and self.random.random() < 0.4 else []
        kinds += ["block"] if body.name == "PLC_PRG" else []
        kind = self.random.choice(kinds)
        made: Node = getattr(self, f"_{kind}")(body, depth, loops)
        return made

    def _assign(self, body: Body, depth: int, loops: int) -> Node:
        target, value = self.random.choice(body.variables), self._expression(body)
        return ("assign", self._add(depth, f"{target} := {_text(value)};"), target, value)

    def _call(self, body: Body, depth: int, loops: int) -> Node:
        known = len(self.functions) if body.name not in ("F0", "F1", "F2") else int(body.name[1])
        if not known:
            return self._assign(body, depth, loops)
        target = self.random.choice(body.variables)
        calls = [
            (self.random.randrange(known), self._expression(body), self._expression(body))
            for _ in range(self.random.randint(1, 2))
        ]
        text = " + ".join(f"F{n}({_text(a)}, {_text(b)})" for n, a, b in calls)
        return ("call", self._add(depth, f"{target} := ({text}) MOD 97;"), target, calls)

    def _block(self, body: Body, depth: int, loops: int) -> Node:
        name, value = self.random.choice(["one", "two"]), self._expression(body)
        return ("block", self._add(depth, f"{name}(a := {_text(value)});"), name, value)

    def _if(self, body: Body, depth: int, loops: int, word: str = "IF") -> Node:
        """Each ELSIF is a statement in the ELSE of the one before."""
        left, right = self._expression(body), self._expression(body)
        line = self._add(depth, f"{word} {_text(left)} > {_text(right)} THEN")
        then: list[Node] = []
        otherwise: list[Node] = []
        self._statements(body, then, 2, depth + 1, loops)
        if self.random.random() < 0.4:
            otherwise.append(self._if(body, depth, loops, "ELSIF"))
            return ("if", line, left, right, then, otherwise)
        self._add(depth, "ELSE")
        self._statements(body, otherwise, 2, depth + 1, loops)
        self._add(depth, "END_IF")
        return ("if", line, left, right, then, otherwise)

    def _case(self, body: Body, depth: int, loops: int) -> Node:
        value = self._expression(body)
        line = self._add(depth, f"CASE ({_text(value)}) MOD 3 OF")
        branches: list[list[Node]] = []
        for label in ("0:", "1:", "ELSE"):
            self._add(depth, label)
            branches.append([])
            self._statements(body, branches[-1], 2, depth + 1, loops)
        self._add(depth, "END_CASE")
        return ("case", line, value, branches)

    def _for(self, body: Body, depth: int, loops: int) -> Node:
        stop = self.random.randint(0, 3)
        line = self._add(depth, f"FOR i{loops} := 1 TO {stop} DO")
        inside: list[Node] = []
        self._statements(body, inside, 2, depth + 1, loops + 1)
        self._add(depth, "END_FOR")
        return ("for", line, stop, inside)

    def _while(self, body: Body, depth: int, loops: int) -> Node:
        count = self.random.randint(0, 3)
        first = self._add(depth, f"i{loops} := {count};")
        line = self._add(depth, f"WHILE i{loops} > 0 DO")
        step = self._add(depth + 1, f"i{loops} := i{loops} - 1;")
        inside: list[Node] = []
        self._statements(body, inside, 2, depth + 1, loops + 1)
        self._add(depth, "END_WHILE")
        return ("while", line, first, step, count, inside)

    def _repeat(self, body: Body, depth: int, loops: int) -> Node:
        count = self.random.randint(1, 3)
        first = self._add(depth, f"i{loops} := {count};")
        line = self._add(depth, "REPEAT")
        step = self._add(depth + 1, f"i{loops} := i{loops} - 1;")
        inside: list[Node] = []
        self._statements(body, inside, 2, depth + 1, loops + 1)
        end = self._add(depth, f"UNTIL i{loops} <= 0")
        self._add(depth, "END_REPEAT")
        return ("repeat", line, first, step, end, count, inside)

    def _return(self, body: Body, depth: int, loops: int) -> Node:
        return ("return", self._add(depth, "RETURN;"))

    def _exit(self, body: Body, depth: int, loops: int) -> Node:
        return ("exit", self._add(depth, "EXIT;"))

    def _continue(self, body: Body, depth: int, loops: int) -> Node:
        return ("continue", self._add(depth, "CONTINUE;"))

    # -- run -----------------------------------------------------------------------------------------

    def cycle(self) -> list[Event]:
        """The statements of the next cycle."""
        events: list[Event] = []
        own = self.memory.setdefault("PLC_PRG", dict.fromkeys("xyz", 0))
        self._run(self.main, own, (), events)
        return events

    def _run(self, body: Body, values: dict[str, int], above: tuple[int, ...], events: list[Event]) -> None:
        self._activations += 1
        here = (*above, self._activations)
        try:
            for node in body.statements:
                self._do(node, values, here, events)
        except _Return:
            pass

    def _do(self, node: Node, v: dict[str, int], here: tuple[int, ...], events: list[Event]) -> None:
        match node:
            case ("while" | "repeat", *_):
                self._counted(node, v, here, events)
                return
            case _:
                events.append((node[1], here))
        match node:
            case ("assign", _, target, value):
                v[target] = _value(value, v)
            case ("call", _, target, calls):
                total = 0
                for number, a, b in calls:
                    body = self.functions[number]
                    inner = dict.fromkeys(body.variables, 0) | {"a": _value(a, v), "b": _value(b, v)}
                    self._run(body, inner, here, events)
                    total += inner[body.name]
                v[target] = total % 97
            case ("block", _, name, value):
                inner = self.memory.setdefault(name, dict.fromkeys(self.block.variables, 0))
                inner["a"] = _value(value, v)
                self._run(self.block, inner, here, events)
            case ("if", _, left, right, then, otherwise):
                for inside in then if _value(left, v) > _value(right, v) else otherwise:
                    self._do(inside, v, here, events)
            case ("case", _, value, branches):
                for inside in branches[_value(value, v) % 3]:
                    self._do(inside, v, here, events)
            case ("for", line, stop, body):
                for _ in range(stop):
                    if not self._pass(body, v, here, events):
                        break
                    events.append((line, here))
            case ("return", _):
                raise _Return
            case ("exit", _):
                raise _Exit
            case ("continue", _):
                raise _Continue

    def _counted(self, node: Node, v: dict[str, int], here: tuple[int, ...], events: list[Event]) -> None:
        line, first, step, *rest = node[1:]
        count, body, again = rest[-2], rest[-1], rest[0] if node[0] == "repeat" else line
        events += [(first, here), (line, here)]
        while count > 0:
            count -= 1
            events.append((step, here))
            if not self._pass(body, v, here, events):
                break
            events.append((again, here))

    def _pass(self, body: list[Node], v: dict[str, int], here: tuple[int, ...], events: list[Event]) -> bool:
        """One pass of a loop; False when it was left by EXIT."""
        try:
            for inside in body:
                self._do(inside, v, here, events)
        except _Continue:
            return True
        except _Exit:
            return False
        return True


def _counters() -> list[str]:
    return ["i0", "i1"]


def _value(node: Node, v: dict[str, int]) -> int:
    match node:
        case ("const", number):
            return int(number)
        case ("var", name):
            return v[name]
        case ("+", left, right):
            return (_value(left, v) + _value(right, v)) % 97
    return (_value(node[1], v) * _value(node[2], v)) % 97


def _text(node: Node) -> str:
    match node:
        case ("const" | "var", what):
            return str(what)
    return f"(({_text(node[1])} {node[0]} {_text(node[2])}) MOD 97)"


def steps(events: list[Event], command: str, at: int) -> Iterator[int]:
    """Where a step that begins at an event may end: the next event, for `step_over` of an activation that is
    running there, for `step_out` of one that called it. Ends with the events; then the next cycle begins."""
    running = events[at][1]
    allowed = set(running if command == "step_over" else running[:-1])
    for later in range(at + 1, len(events)):
        if command == "step_into" or events[later][1][-1] in allowed:
            yield later
