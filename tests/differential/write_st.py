"""A program as ST."""

from __future__ import annotations

import datetime
import itertools
from typing import Any

import typed_tree as tree

CHECKS = """FUNCTION CheckBounds : DINT
VAR_INPUT index, lower, upper : DINT; END_VAR
CheckBounds := LIMIT(lower, index, upper);
END_FUNCTION
FUNCTION CheckDivInt : DINT
VAR_INPUT divisor : DINT; END_VAR
CheckDivInt := SEL(divisor = 0, divisor, 1);
END_FUNCTION
FUNCTION CheckDivLInt : LINT
VAR_INPUT divisor : LINT; END_VAR
CheckDivLInt := SEL(divisor = 0, divisor, 1);
END_FUNCTION
FUNCTION CheckDivReal : REAL
VAR_INPUT divisor : REAL; END_VAR
CheckDivReal := SEL(divisor = 0, divisor, 1);
END_FUNCTION
FUNCTION CheckDivLReal : LREAL
VAR_INPUT divisor : LREAL; END_VAR
CheckDivLReal := SEL(divisor = 0, divisor, 1);
END_FUNCTION
FUNCTION CheckRangeSigned : DINT
VAR_INPUT value, lower, upper : DINT; END_VAR
CheckRangeSigned := LIMIT(lower, value, upper);
END_FUNCTION
FUNCTION CheckRangeUnsigned : UDINT
VAR_INPUT value, lower, upper : UDINT; END_VAR
CheckRangeUnsigned := LIMIT(lower, value, upper);
END_FUNCTION
"""
"""What a program that checks for itself brings: it limits, and divides by 1 instead of 0."""


def literal(type_: tree.Type, value: Any, untyped: bool = False) -> str:
    """A literal, also an initial value of an array or structure; equal elements are counted."""
    if isinstance(type_, tree.Struct | tree.Block):
        members = (
            dict(type_.members) if isinstance(type_, tree.Struct) else {v.name: v.type for v in type_.members}
        )
        return f"({', '.join(f'{name} := {literal(members[name], v)}' for name, v in value.items())})"
    if isinstance(type_, tree.Array):
        texts = [literal(type_.element, v) for v in value]
        runs = [(text, len(list(run))) for text, run in itertools.groupby(texts)]
        return f"[{', '.join(text if count == 1 else f'{count}({text})' for text, count in runs)}]"
    if isinstance(type_, tree.Enum):
        names = {number: name for name, number in type_.members}
        return f"{type_.name}.{names[value]}"
    base = tree.base_of(type_)
    if isinstance(base, tree.Text):
        return f'"{value}"' if base.wide else f"'{value}'"
    if base == tree.BOOL:
        return "TRUE" if value else "FALSE"
    if base.kind == "real":
        text = repr(value)
        mantissa, _, exponent = text.partition("e")
        text = (mantissa if "." in mantissa else mantissa + ".0") + (f"E{exponent}" if exponent else "")
        return text if untyped else f"{base.name}#{text}"
    if base.unit_ns:
        return _clock(base, value)
    return str(value) if untyped else f"{base.name}#{value}"


def _clock(type_: tree.Scalar, value: int) -> str:
    if type_.kind == "time":
        return f"T#{value}ms" if type_ == tree.TIME else f"LTIME#{value}ns"
    moment = datetime.datetime(1970, 1, 1) + datetime.timedelta(microseconds=value * type_.unit_ns // 1000)
    if type_ in (tree.DATE, tree.LDATE):
        return f"{type_.name}#{moment:%Y-%m-%d}"
    if type_ == tree.LTOD:
        return f"LTOD#{moment:%H:%M:%S}.{value % 1_000_000_000:09}"
    if type_ == tree.TOD:
        return f"TOD#{moment:%H:%M:%S}.{moment.microsecond // 1000:03}"
    return f"{type_.name}#{moment:%Y-%m-%d-%H:%M:%S}"


def expression(e: Any) -> str:
    """An expression, with parentheses around every operation."""
    if isinstance(e, tree.Literal):
        return literal(e.type, e.value, e.untyped)
    if isinstance(e, tree.Name):
        return e.name
    if isinstance(e, tree.Member):
        return f"{expression(e.base)}.{e.name}"
    if isinstance(e, tree.Get):
        owner = f"{e.via}^" if e.via else expression(e.base) if e.base else ""
        return f"{owner}.{e.name}" if owner else e.name
    if isinstance(e, tree.Index):
        return f"{expression(e.base)}[{', '.join(expression(i) for i in e.indices)}]"
    if isinstance(e, tree.Deref):
        assert isinstance(e.base.type, tree.Pointer)
        return expression(e.base) + ("" if e.base.type.reference else "^")
    if isinstance(e, tree.Bit):
        return f"{expression(e.base)}.{e.constant_name or e.bit}"
    if isinstance(e, tree.Bound):
        return f"{'UPPER' if e.upper else 'LOWER'}_BOUND({e.array.name}, {e.dimension + 1})"
    if isinstance(e, tree.IsNull):
        return f"({e.pointer.name} {'=' if e.equal else '<>'} NULL)"
    if isinstance(e, tree.SizeOf):
        return f"SIZEOF({e.of.name})"
    if isinstance(e, tree.Unary):
        return f"({e.op} {expression(e.operand)})"
    if isinstance(e, tree.Binary | tree.Clock):
        return f"({expression(e.left)} {e.op} {expression(e.right)})"
    if isinstance(e, tree.Applied):
        return _called(e.call)
    if isinstance(e, tree.Chained):
        return f"({expression(e.target)} := {expression(e.value)})"
    args = ", ".join(expression(a) for a in e.args)
    if e.name in ("convert", "text"):
        target = e.type.name.partition("(")[0]
        return f"{e.taken[0].name.partition('(')[0]}_TO_{target}({args})"
    return f"{e.name}({args})"


def _called(s: tree.CallFunction) -> str:
    args = [f"{v.name} := {expression(e)}" for v, e in zip(s.function.inputs, s.inputs, strict=True)]
    args += [f"{v.name} := {expression(e)}" for v, e in zip(s.function.in_outs, s.in_outs, strict=True)]
    args += [f"{name} => {expression(e)}" for name, e in s.outputs]
    owner = f"{s.via}^" if s.via else expression(s.instance) if s.instance else ""
    callee = f"{owner}.{s.function.name}" if owner else s.function.name
    return f"{callee}({', '.join(args)})"


def statements(body: list[Any], indent: str = "") -> list[str]:
    """Lines of a body."""
    lines: list[str] = []
    deeper = indent + "    "
    for s in body:
        if isinstance(s, tree.Assign):
            lines.append(f"{indent}{expression(s.target)} {s.op} {expression(s.value)};")
        elif isinstance(s, tree.If):
            word = "IF"
            for condition, inner in s.branches:
                lines += [f"{indent}{word} {expression(condition)} THEN", *statements(inner, deeper)]
                word = "ELSIF"
            lines += [f"{indent}ELSE", *statements(s.otherwise, deeper)] if s.otherwise else []
            lines.append(f"{indent}END_IF")
        elif isinstance(s, tree.Case):
            lines.append(f"{indent}CASE {expression(s.selector)} OF")
            for ranges, inner in s.branches:
                labels = ", ".join(str(a) if a == z else f"{a}..{z}" for a, z in ranges)
                lines += [f"{indent}{labels}:", *statements(inner, deeper)]
            lines += [f"{indent}ELSE", *statements(s.otherwise, deeper)] if s.otherwise else []
            lines.append(f"{indent}END_CASE")
        elif isinstance(s, tree.For):
            step = str(s.step) if isinstance(s.step, int) else expression(s.step)
            by = f" BY {step}" if s.step != 1 else ""
            limits = f"{expression(s.start)} TO {expression(s.stop)}"
            lines.append(f"{indent}FOR {expression(s.counter)} := {limits}{by} DO")
            lines += [*statements(s.body, deeper), f"{indent}END_FOR"]
        elif isinstance(s, tree.While):
            lines += _while(s, indent)
        elif isinstance(s, tree.Jump):
            lines.append(f"{indent}{s.word};")
        elif isinstance(s, tree.CallFunction):
            assert s.target is not None
            lines.append(f"{indent}{expression(s.target)} := {_called(s)};")
        elif isinstance(s, tree.CallBase):
            lines.append(f"{indent}SUPER^();")
        elif isinstance(s, tree.Bind):
            lines.append(indent + _bind(s))
        elif isinstance(s, tree.Try):
            lines += _try(s, indent)
        elif isinstance(s, tree.New):
            lines += _new(s, indent)
        elif isinstance(s, tree.Attempt):
            lines += [
                f"{indent}{s.target.name} ?= {expression(s.source)};",
                f"{indent}IF {s.target.name} <> NULL THEN",
                *statements(s.body, deeper),
                *([f"{indent}ELSE", *statements(s.otherwise, deeper)] if s.otherwise else []),
                f"{indent}END_IF",
            ]
        else:
            args = [f"EN := {expression(s.enable)}"] if s.enable else []
            args += [f"{name} := {expression(e)}" for name, e in s.inputs]
            args += [f"ENO => {expression(s.success)}"] if s.success else []
            args += [f"{name} => {expression(e)}" for name, e in s.outputs]
            lines.append(f"{indent}{expression(s.instance)}({', '.join(args)});")
    return lines


def _bind(s: tree.Bind) -> str:
    place = expression(s.place)
    if isinstance(s.target.type, tree.Interface):
        return f"{s.target.name} := {place};"
    assert isinstance(s.target.type, tree.Pointer)
    if s.target.type.reference:
        return f"{s.target.name} REF= {place};"
    return f"{s.target.name} := {'REF' if s.target.type.ref_to else 'ADR'}({place});"


def _try(s: tree.Try, indent: str) -> list[str]:
    deeper = indent + "    "
    lines = [f"{indent}__TRY", *statements(s.body, deeper)]
    if s.handler is not None:
        caught = f"({s.code.name})" if s.code else ""
        lines += [f"{indent}__CATCH{caught}", *statements(s.handler, deeper)]
    if s.final is not None:
        lines += [f"{indent}__FINALLY", *statements(s.final, deeper)]
    return [*lines, f"{indent}__ENDTRY"]


def _new(s: tree.New, indent: str) -> list[str]:
    target = s.pointer.type
    assert isinstance(target, tree.Pointer)
    made = target.target.name
    if isinstance(target.target, tree.Block):
        made += _arguments(target.target, s.arguments)
    return [
        f"{indent}{s.pointer.name} := __NEW({made});",
        *statements(s.body, indent),
        f"{indent}__DELETE({s.pointer.name});",
    ]


def _arguments(block: tree.Block, given: tuple[Any, ...] | None) -> str:
    """What FB_Init gets, by name."""
    if not given or block.maker is None:
        return ""
    pairs = zip(block.maker.inputs, given, strict=True)
    return f"({', '.join(f'{v.name} := {literal(v.type, value)}' for v, value in pairs)})"


def _while(s: tree.While, indent: str) -> list[str]:
    deeper, guard = indent + "    ", s.guard.name
    body = [f"{deeper}{guard} := {guard} + 1;", *statements(s.body, deeper)]
    head = f"{indent}{guard} := 0;"
    condition = expression(s.condition)
    if s.until:
        return [
            head,
            f"{indent}REPEAT",
            *body,
            f"{indent}UNTIL {condition} OR_ELSE {guard} >= {s.limit}",
            f"{indent}END_REPEAT",
        ]
    return [head, f"{indent}WHILE {condition} AND_THEN {guard} < {s.limit} DO", *body, f"{indent}END_WHILE"]


def _section(word: str, variables: list[tree.Variable]) -> list[str]:
    constants = [v for v in variables if v.constant]
    return [
        *_block_of(word, [v for v in variables if not v.constant]),
        *_block_of(f"{word} CONSTANT", constants),
    ]


def _block_of(word: str, variables: list[tree.Variable]) -> list[str]:
    if not variables:
        return []
    lines = [word]
    for v in variables:
        initial = "" if v.initial is None else f" := {literal(v.type, v.initial)}"
        made = _arguments(v.type, v.arguments) if isinstance(v.type, tree.Block) else ""
        lines.append(f"    {v.name} : {v.type.name}{made}{initial};")
    return [*lines, "END_VAR"]


def _head(f: tree.Function, word: str) -> list[str]:
    return [
        f"{word} {f.name} : {f.result.name}",
        *_section("VAR_INPUT", f.inputs),
        *_section("VAR_IN_OUT", f.in_outs),
        *_section("VAR_OUTPUT", f.outputs),
    ]


def _function(f: tree.Function, word: str) -> list[str]:
    return [
        *_head(f, word),
        *_section("VAR", f.locals),
        *_section("VAR_STAT", f.statics),
        *_section("VAR_INST", f.kept),
        *statements(f.body),
        f"END_{word}",
    ]


def _parents(b: tree.Block) -> list[str]:
    found = [f"EXTENDS {b.base.name}"] if b.base else []
    return found + ([f"IMPLEMENTS {', '.join(i.name for i in b.interfaces)}"] if b.interfaces else [])


def _block(b: tree.Block) -> list[str]:
    lines = [
        *(["{attribute 'enable_dynamic_creation'}"] if b.dynamic else []),
        " ".join([f"FUNCTION_BLOCK {b.name}", *_parents(b)]),
        *_section("VAR_INPUT", b.inputs),
        *_section("VAR_OUTPUT", b.outputs),
        *_section("VAR", b.locals),
        *_section("VAR_STAT", b.statics),
        *statements(b.body),
    ]
    if b.init is not None:
        lines += [
            "METHOD FB_Init : BOOL",
            "VAR_INPUT bInitRetains, bInCopyCode : BOOL; END_VAR",
            *_section("VAR_INPUT", b.init.inputs),
            *statements(b.init.body),
            "END_METHOD",
        ]
    for method in b.methods:
        lines += _function(method, "METHOD")
    for p in b.properties:
        lines += [f"PROPERTY {p.name} : {p.type.name}"]
        for word, f in (("GET", p.getter), ("SET", p.setter)):
            lines += [word, *_section("VAR", f.locals), *statements(f.body), f"END_{word}"]
        lines.append("END_PROPERTY")
    return [*lines, "END_FUNCTION_BLOCK"]


def program(p: tree.Program) -> str:
    """The whole text; the program is PLC_PRG."""
    return "\n".join(objects(p).values()) + "\n"


def objects(p: tree.Program) -> dict[str, str]:
    """The text of each object by its name."""
    found: dict[str, list[str]] = {}
    for t in p.types:
        found[t.name] = _type(t)
    if p.bits:
        named = " ".join(f"{name} : INT := {bit};" for name, bit in p.bits)
        found["Bits"] = [f"VAR_GLOBAL CONSTANT {named} END_VAR"]
    if p.checks:
        found["Checks"] = [CHECKS.rstrip()]
    if p.globals:
        found["Globals"] = _section("VAR_GLOBAL", p.globals)
    for f in p.functions:
        found[f.name] = _function(f, "FUNCTION")
    for i in p.interfaces:
        found[i.name] = _interface(i)
    for b in p.blocks:
        found[b.name] = _block(b)
    found["PLC_PRG"] = ["PROGRAM PLC_PRG", *_section("VAR", p.variables), *statements(p.body), "END_PROGRAM"]
    return {name: "\n".join(lines) for name, lines in found.items()}


def _type(t: tree.Enum | tree.Struct) -> list[str]:
    if isinstance(t, tree.Enum):
        members = ", ".join(f"{name} := {number}" for name, number in t.members)
        return [f"TYPE {t.name} : ({members}) {t.base.name}; END_TYPE"]
    own = t.members[len(t.base.members) :] if t.base is not None else t.members
    members = " ".join(f"{name} : {m.name};" for name, m in own)
    extends = f" EXTENDS {t.base.name}" if t.base is not None else ""
    word = "UNION" if t.union else "STRUCT"
    lines = [] if t.pack is None else [f"{{attribute 'pack_mode' := '{t.pack}'}}"]
    return [*lines, f"TYPE {t.name}{extends} : {word} {members} END_{word} END_TYPE"]


def _interface(i: tree.Interface) -> list[str]:
    lines = [f"INTERFACE {i.name}"]
    for method in i.methods:
        lines += [*_head(method, "METHOD"), "END_METHOD"]
    for of in i.properties:
        accessors = ["GET", "END_GET", "SET", "END_SET"]
        lines += [f"PROPERTY {of.name} : {of.type.name}", *accessors, "END_PROPERTY"]
    return [*lines, "END_INTERFACE"]


def paths(variables: list[tree.Variable], prefix: str) -> list[tuple[str, tree.Type, list[Any]]]:
    """All simple variables: path, type, and the keys that lead to it in the reference."""
    found: list[tuple[str, tree.Type, list[Any]]] = []
    for v in variables:
        _paths(f"{prefix}{v.name}", v.type, [v.name], found)
    return found


def _paths(
    path: str, type_: tree.Type, keys: list[Any], found: list[tuple[str, tree.Type, list[Any]]]
) -> None:
    if isinstance(type_, tree.Array):
        (low, high), rest = type_.bounds[0], type_.bounds[1:]
        if rest:
            (low2, high2) = rest[0]
            for i in range(low, high + 1):
                for j in range(low2, high2 + 1):
                    _paths(f"{path}[{i},{j}]", type_.element, [*keys, i - low, j - low2], found)
            return
        for i in range(low, high + 1):
            _paths(f"{path}[{i}]", type_.element, [*keys, i - low], found)
    elif isinstance(type_, tree.Struct):
        for name, member in type_.members:
            _paths(f"{path}.{name}", member, [*keys, name], found)
    elif isinstance(type_, tree.Block):
        for v in type_.members:
            _paths(f"{path}.{v.name}", v.type, [*keys, v.name], found)
    elif not isinstance(type_, tree.Pointer | tree.Interface):
        found.append((path, type_, keys))
