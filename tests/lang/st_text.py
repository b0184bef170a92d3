"""Syntax trees back to text, every operation in parentheses, and a comparison that ignores places."""

from __future__ import annotations

from dataclasses import fields

from tappet.lang import ast
from tappet.lang.diagnostics import Diagnostic
from tappet.lang.parser import parse
from tappet.lang.source import Source

_PLACES = {"span", "name_span", "target_span", "source", "owner"}
_RESOLVED = {"type", "constant", "is_constant", "symbol", "bit", "operand_type", "parameter", "number"}
_IGNORED = _PLACES | _RESOLVED | {"untyped", "expansion"}
_COMPOUND = (ast.If, ast.Case, ast.For, ast.While, ast.RepeatUntil, ast.Try)


def expression(node: ast.Expr) -> str:
    """ST text of an expression."""
    match node:
        case ast.Literal(text=text):
            return text
        case ast.Name(name=name, leading_dot=dot):
            return f".{name}" if dot else name
        case ast.Member(base=base, name=name):
            return f"{expression(base)}.{name}"
        case ast.Index(base=base, indices=indices):
            return f"{expression(base)}[{', '.join(map(expression, indices))}]"
        case ast.Deref(base=base):
            return f"{expression(base)}^"
        case ast.Unary(op=op, operand=operand):
            return f"({op} {expression(operand)})"
        case ast.Binary(op=op, left=left, right=right):
            return f"({expression(left)} {op} {expression(right)})"
        case ast.Call(callee=callee, args=args):
            return f"{expression(callee)}({', '.join(map(argument, args))})"
        case ast.AssignExpr(op=op, target=target, value=value):
            return f"({expression(target)} {op} {expression(value)})"
        case ast.ArrayInit(elements=elements):
            return f"[{', '.join(map(expression, elements))}]"
        case ast.Repeat(count=count, values=values):
            return f"{expression(count)}({', '.join(map(expression, values))})"
        case ast.StructInit(fields=entries):
            return f"({', '.join(map(argument, entries))})"
        case ast.This():
            return "THIS"
        case ast.Super():
            return "SUPER"
        case ast.ErrorExpr():
            return "?"
    raise AssertionError(node)


def argument(node: ast.Argument) -> str:
    """ST text of an actual parameter."""
    value = expression(node.value) if node.value else ""
    return value if node.name is None else f"{node.name} {'=>' if node.output else ':='} {value}".strip()


def type_text(node: ast.TypeRef) -> str:
    """ST text of a type."""
    match node:
        case ast.NamedType(name=name, args=args):
            return name if args is None else f"{name}({', '.join(map(argument, args))})"
        case ast.StringType(wide=wide, length=length):
            return ("W" if wide else "") + "STRING" + (f"({expression(length)})" if length else "")
        case ast.SubrangeType(base=base, low=low, high=high):
            return f"{base}({expression(low)}..{expression(high)})"
        case ast.ArrayType(bounds=bounds, element=element):
            shown = (f"{expression(a)}..{expression(b)}" if a and b else "*" for a, b in bounds)
            return f"ARRAY[{', '.join(shown)}] OF {type_text(element)}"
        case ast.PointerType(base=base):
            return f"POINTER TO {type_text(base)}"
        case ast.ReferenceType(base=base):
            return f"REFERENCE TO {type_text(base)}"
        case ast.EnumType(values=values, base=base):
            shown = (v.name + (f" := {expression(v.value)}" if v.value else "") for v in values)
            return f"({', '.join(shown)})" + (f" {base}" if base else "")
        case ast.StructType(members=members, union=union):
            word = "UNION" if union else "STRUCT"
            return f"{word} {' '.join(map(variable, members))} END_{word}"
    raise AssertionError(node)


def variable(node: ast.VarDecl) -> str:
    """ST text of a declaration."""
    address = f" AT {node.address}" if node.address else ""
    operator = "REF=" if node.initial_ref else ":="
    initial = f" {operator} {expression(node.initial)}" if node.initial else ""
    return f"{node.name}{address} : {type_text(node.type_ref)}{initial};"


def statements(nodes: list[ast.Stmt]) -> str:
    """ST text of a list of statements, separated by blanks."""
    texts = []
    for node, following in zip(nodes, [*nodes, None][1:], strict=True):
        # a `;` behind an END_ keyword belongs to it
        own_end = isinstance(node, _COMPOUND) and isinstance(following, ast.Empty)
        texts.append(statement(node) + (";" if own_end else ""))
    return " ".join(texts)


def statement(node: ast.Stmt) -> str:
    """ST text of a statement."""
    return (f"{node.label}: " if node.label else "") + _unlabelled(node)


def _unlabelled(node: ast.Stmt) -> str:
    match node:
        case ast.Assign(op=op, target=target, value=value):
            return f"{expression(target)} {op} {expression(value)};"
        case ast.CallStmt(call=call):
            return f"{expression(call)};"
        case ast.ExprStmt(expr=expr):
            return f"{expression(expr)};"
        case ast.If(branches=branches, otherwise=otherwise):
            parts = [f"{expression(c)} THEN {statements(b)}" for c, b in branches]
            text = "IF " + " ELSIF ".join(parts)
            return text + (f" ELSE {statements(otherwise)}" if otherwise is not None else "") + " END_IF"
        case ast.Case(selector=selector, branches=branches, otherwise=otherwise):
            text = f"CASE {expression(selector)} OF"
            for branch in branches:
                text += f" {', '.join(map(case_range, branch.selectors))}: {statements(branch.body)}"
            return text + (f" ELSE {statements(otherwise)}" if otherwise is not None else "") + " END_CASE"
        case ast.For(variable=var, start=start, stop=stop, step=step, body=body):
            by = f" BY {expression(step)}" if step else ""
            head = f"FOR {expression(var)} := {expression(start)} TO {expression(stop)}{by}"
            return f"{head} DO {statements(body)} END_FOR"
        case ast.While(condition=condition, body=body):
            return f"WHILE {expression(condition)} DO {statements(body)} END_WHILE"
        case ast.RepeatUntil(condition=condition, body=body):
            return f"REPEAT {statements(body)} UNTIL {expression(condition)} END_REPEAT"
        case ast.Exit():
            return "EXIT;"
        case ast.Continue():
            return "CONTINUE;"
        case ast.Return():
            return "RETURN;"
        case ast.Jump(target=target):
            return f"JMP {target};"
        case ast.Empty(label=label):
            return "" if label else ";"
        case ast.PragmaStmt(pragma=pragma):
            return f"{{{pragma.text}}}"
        case ast.Try(body=body, exception=exception, handler=handler, final=final):
            caught = f"({expression(exception)})" if exception else ""
            rest = f"__CATCH{caught} {statements(handler)} __FINALLY {statements(final)}"
            return f"__TRY {statements(body)} {rest} __ENDTRY"
    raise AssertionError(node)


def case_range(node: ast.CaseRange) -> str:
    """ST text of one CASE label."""
    return expression(node.low) + (f"..{expression(node.high)}" if node.high else "")


def same(a: object, b: object) -> bool:
    """Whether two trees are equal apart from places and what the analysis fills in."""
    if isinstance(a, list | tuple) and isinstance(b, list | tuple):
        return len(a) == len(b) and all(same(x, y) for x, y in zip(a, b, strict=True))
    if isinstance(a, ast.Node):
        return type(a) is type(b) and all(
            same(getattr(a, f.name), getattr(b, f.name))
            for f in fields(a)
            if f.name not in _IGNORED and not (f.name == "target" and isinstance(a, ast.Call))
        )
    return type(a) is type(b) and a == b


def codes(diagnostics: list[Diagnostic]) -> list[str]:
    """`line:column code` of each, 1-based."""
    return [f"{d.span.line + 1}:{d.span.column + 1} {d.code}" for d in diagnostics]


def body_of(code: str, name: str = "PLC_PRG") -> list[ast.Stmt]:
    """The statements of a program with this code; there must be no message."""
    result = parse(Source(name, f"PROGRAM {name}\n{code}\nEND_PROGRAM"))
    assert [str(d) for d in result.diagnostics] == []
    (program,) = result.unit.declarations
    assert isinstance(program, ast.Pou)
    return program.body
