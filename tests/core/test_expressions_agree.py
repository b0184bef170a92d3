"""Folding in the front end and compiled code are two implementations of one arithmetic: they must agree.

Random expressions are built twice into one program: over typed literals (folded) and variables (compiled).
"""

from __future__ import annotations

import random

import pytest
from linked_application import loaded

from tappet.codegen.build import BuildOptions, BuildSession, build_application
from tappet.lang.source import Source

_INTEGERS = {
    "SINT": (-128, 127), "INT": (-32768, 32767), "DINT": (-(2**31), 2**31 - 1), "LINT": (-(2**63), 2**63 - 1),
    "USINT": (0, 255), "UINT": (0, 65535), "UDINT": (0, 2**32 - 1), "ULINT": (0, 2**64 - 1),
    "BYTE": (0, 255), "WORD": (0, 65535), "DWORD": (0, 2**32 - 1), "LWORD": (0, 2**64 - 1),
}  # fmt: skip
_SIGNED = ["SINT", "INT", "DINT", "LINT"]
_UNSIGNED = ["USINT", "UINT", "UDINT", "ULINT"]
_BITS = ["BYTE", "WORD", "DWORD", "LWORD"]
SESSION = BuildSession()


class Builder:
    """One random program."""

    def __init__(self, seed: int) -> None:
        self.random = random.Random(seed)
        self.variables: list[tuple[str, str, str]] = []

    def leaf(self, type_: str) -> tuple[str, str]:
        low, high = _INTEGERS[type_]
        special = [low, high, 0, 1, low + 1, high - 1, 2, 7]
        value = self.random.choice([*special, self.random.randint(low, high), self.random.randint(0, 100)])
        name = f"v{len(self.variables)}"
        literal = f"{type_}#{value}" if value >= 0 else f"{type_}#-{-value}"
        self.variables.append((name, type_, literal))
        return literal, name

    def expression(self, type_: str, depth: int) -> tuple[str, str]:
        """(folded form, compiled form), both of a type that converts silently to LINT or ULINT."""
        if depth == 0 or self.random.random() < 0.2:
            return self.leaf(type_)
        kind = self.random.random()
        if type_ in _BITS and kind < 0.5:
            return self.binary(self.random.choice(["AND", "OR", "XOR"]), type_, type_, depth)
        if kind < 0.1:
            folded, compiled = self.expression(type_, depth - 1)
            return (
                (f"(NOT {folded})", f"(NOT {compiled})")
                if type_ in _BITS
                else (f"(-{folded})", f"(-{compiled})")
            )
        if kind < 0.25:
            operator = self.random.choice(["SHL", "SHR"] + (["ROL", "ROR"] if type_ in _BITS else []))
            folded, compiled = self.leaf(type_)
            count = self.random.randint(0, 70)
            name = f"v{len(self.variables)}"
            self.variables.append((name, "USINT", str(count)))
            return f"{operator}({folded}, USINT#{count})", f"{operator}({compiled}, {name})"
        if kind < 0.35:
            folded, compiled = self.expression(type_, depth - 1)
            target = self.random.choice(_SIGNED + _UNSIGNED)
            call = f"{type_}_TO_{target}"
            back = f"{target}_TO_{type_}"
            return f"{back}({call}({folded}))", f"{back}({call}({compiled}))"
        if kind < 0.5:
            operator = self.random.choice(["MIN", "MAX"])
            a, b = self.leaf(type_), self.leaf(type_)
            return f"{operator}({a[0]}, {b[0]})", f"{operator}({a[1]}, {b[1]})"
        return self.binary(self.random.choice(["+", "-", "*", "/", "MOD"]), type_, type_, depth)

    def binary(self, operator: str, left: str, right: str, depth: int) -> tuple[str, str]:
        a = self.expression(left, depth - 1)
        if operator in ("/", "MOD"):
            low, high = _INTEGERS[right]
            value = self.random.choice([1, 2, 3, 7, high, -1 if low < 0 else 5])
            literal = f"{right}#{value}" if value >= 0 else f"{right}#-{-value}"
            name = f"v{len(self.variables)}"
            self.variables.append((name, right, literal))
            b = (literal, name)
        else:
            b = self.expression(right, depth - 1)
        return f"({a[0]} {operator} {b[0]})", f"({a[1]} {operator} {b[1]})"


def program(seed: int, count: int) -> tuple[str, list[tuple[str, str]]]:
    builder = Builder(seed)
    declarations: list[str] = []
    body: list[str] = []
    shown: list[tuple[str, str]] = []
    for number in range(count):
        type_ = builder.random.choice(_SIGNED + _UNSIGNED + _BITS)
        folded, compiled = builder.expression(type_, 3)
        declarations.append(f"f{number}, c{number} : {type_}; b{number}, d{number} : BOOL;")
        body += [
            f"f{number} := DWORD_TO_{type_}(16#55);",
            f"f{number} := LINT_TO_{type_}(ANY_TO_LINT({folded}));",
            f"c{number} := LINT_TO_{type_}(ANY_TO_LINT({compiled}));",
            f"b{number} := {folded} > 5;",
            f"d{number} := {compiled} > 5;",
        ]
        shown.append((folded, compiled))
    declarations += [f"{name} : {type_} := {literal};" for name, type_, literal in builder.variables]
    text = (
        "PROGRAM PLC_PRG\nVAR\n"
        + "\n".join(declarations)
        + "\nEND_VAR\n"
        + "\n".join(body)
        + "\nEND_PROGRAM\n"
    )
    return text, shown


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("level", [0, 2])
def test_folded_and_compiled_values_agree(seed: int, level: int) -> None:
    text, shown = program(seed, 30)
    result = build_application([Source("a", text)], (), BuildOptions(level=level), session=SESSION)
    errors = [str(d) for d in result.diagnostics if d.severity == "error"]
    assert errors == []
    assert result.package is not None
    with loaded(result.package) as application:
        application.cycle()
        wrong = [
            (folded, application.read(f"PLC_PRG.f{n}"), application.read(f"PLC_PRG.c{n}"))
            for n, (folded, _) in enumerate(shown)
            if application.read(f"PLC_PRG.f{n}") != application.read(f"PLC_PRG.c{n}")
            or application.read(f"PLC_PRG.b{n}") != application.read(f"PLC_PRG.d{n}")
        ]
    assert wrong == []
