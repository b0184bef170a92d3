"""Operators, operands, calls and aggregates. The expected text has every operation in parentheses."""

from __future__ import annotations

import pytest
from st_text import codes, expression

from tappet.lang import ast
from tappet.lang.parser import parse_expression
from tappet.lang.source import Span


def read(text: str) -> ast.Expr:
    node, diagnostics = parse_expression(text)
    assert [str(d) for d in diagnostics] == []
    return node


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a + b * c", "(a + (b * c))"),
        ("a - b - c", "((a - b) - c)"),
        ("20 / 2 / 5", "((20 / 2) / 5)"),
        ("a MOD b * c", "((a MOD b) * c)"),
        ("-a + b", "((- a) + b)"),
        ("-a * b", "((- a) * b)"),
        ("- -a", "(- (- a))"),
        ("+5", "(+ 5)"),
        ("-a ** 2", "(- (a ** 2))"),
        ("a ** b ** c", "((a ** b) ** c)"),
        ("a ** -b", "(a ** (- b))"),
        ("a * b ** c", "(a * (b ** c))"),
        ("NOT a AND b", "((NOT a) AND b)"),
        ("NOT(a) AND b", "((NOT a) AND b)"),
        ("NOT a = b", "((NOT a) = b)"),
        ("a OR b AND c", "(a OR (b AND c))"),
        ("a OR b XOR c AND d", "(a OR (b XOR (c AND d)))"),
        ("a & b OR c", "((a AND b) OR c)"),
        ("a AND_THEN b OR_ELSE c", "((a AND_THEN b) OR_ELSE c)"),
        ("p <> 0 AND_THEN p^ = 5", "((p <> 0) AND_THEN (p^ = 5))"),
        ("1 < 2 = TRUE", "((1 < 2) = TRUE)"),
        ("a = b <> c", "((a = b) <> c)"),
        ("a <= b >= c", "((a <= b) >= c)"),
        ("a + b < c AND d", "(((a + b) < c) AND d)"),
        ("(a OR b) AND c", "((a OR b) AND c)"),
        ("((a))", "a"),
        ("a.b.c", "a.b.c"),
        ("a[1, i + 1].b^", "a[1, (i + 1)].b^"),
        ("p^[2]^.x", "p^[2]^.x"),
        ("w.3", "w.3"),
        ("w.%X7", "w.7"),
        ("a[i].3", "a[i].3"),
        (".glob", ".glob"),
        (".glob.x", ".glob.x"),
        ("THIS^.x", "THIS^.x"),
        ("SUPER^.m(1)", "SUPER^.m(1)"),
        ("THIS^", "THIS^"),
        ("%IX0.0 AND %m5", "(%IX0.0 AND %M5)"),
        ("NULL", "NULL"),
        ("f()", "f()"),
        ("f(a, b + 1)", "f(a, (b + 1))"),
        ("f(x := 1, y => z)", "f(x := 1, y => z)"),
        ("f(x := , y => )", "f(x :=, y =>)"),
        ("f(x := a.b[2])", "f(x := a.b[2])"),
        ("fb.m(1).n", "fb.m(1).n"),
        ("Lib.GVL.fun(4)", "Lib.GVL.fun(4)"),
        ("f(a)(b)", "f(a)(b)"),
        ("TIME()", "TIME()"),
        ("ADD(7, 2, 4)", "ADD(7, 2, 4)"),
        ("AND(a, b)", "AND(a, b)"),
        ("or(a, b, c)", "OR(a, b, c)"),
        ("XOR(16#0F, 16#FF) = 1", "(XOR(16#0F, 16#FF) = 1)"),
        ("MOD(a, b) + 1", "(MOD(a, b) + 1)"),
        ("AND_THEN(a, b)", "AND_THEN(a, b)"),
        ("a MOD (b)", "(a MOD b)"),
        ("SEL(a, b, c)", "SEL(a, b, c)"),
        ("SIZEOF(INT)", "SIZEOF(INT)"),
        ("__NEW(BYTE, 25)", "__NEW(BYTE, 25)"),
        ("f(TO := 1, DO => x, THEN := 2)", "f(TO := 1, DO => x, THEN := 2)"),
        ("x.TO + y.END_IF.MOD", "(x.TO + y.END_IF.MOD)"),
        ("a := b", "(a := b)"),
        ("a := b := c + 9", "(a := (b := (c + 9)))"),
        ("(x := f()) AND y", "((x := f()) AND y)"),
        ("a S= b", "(a S= b)"),
        ("a r= b", "(a R= b)"),
        ("a REF= b", "(a REF= b)"),
        ("S = 1", "(S = 1)"),
        ("a AND S = 1", "(a AND (S = 1))"),
        ("(a := 1, b := 2)", "(a := 1, b := 2)"),
        ("(a := 1, b := (c := 2, d := [3]))", "(a := 1, b := (c := 2, d := [3]))"),
        ("[1, 2, 3(7), 2(0, 1)]", "[1, 2, 3(7), 2(0, 1)]"),
        ("[(p := 1), (p := 2)]", "[(p := 1), (p := 2)]"),
        ("[[1, 2], [3(4)]]", "[[1, 2], [3(4)]]"),
        ("[]", "[]"),
        ("[3()]", "[3()]"),
    ],
)
def test_structure(text: str, expected: str) -> None:
    assert expression(read(text)) == expected


def test_functional_operator_is_a_call_of_its_name() -> None:
    node = read("and(a, b)")
    assert isinstance(node, ast.Call)
    assert isinstance(node.callee, ast.Name)
    assert node.callee.name == "AND"


def test_single_value_in_parentheses_is_an_aggregate_only_as_initial_value() -> None:
    assert isinstance(read("(a := 1)"), ast.AssignExpr)
    assert isinstance(read("[(a := 1)]").elements[0], ast.StructInit)  # type: ignore[attr-defined]
    call = read("f(x := (a := 1))")
    assert isinstance(call, ast.Call)
    assert isinstance(call.args[0].value, ast.AssignExpr)


def test_every_node_knows_its_place() -> None:
    node = read("abc[1].de +\n  f(x := 2)")
    assert isinstance(node, ast.Binary)
    assert node.span == Span(0, 0, 1, 11)
    member = node.left
    assert isinstance(member, ast.Member)
    assert (member.span, member.name_span) == (Span(0, 0, 0, 9), Span(0, 7, 0, 9))
    assert isinstance(member.base, ast.Index)
    assert member.base.span == Span(0, 0, 0, 6)
    call = node.right
    assert isinstance(call, ast.Call)
    assert (call.span, call.callee.span, call.args[0].span) == (
        Span(1, 2, 1, 11),
        Span(1, 2, 1, 3),
        Span(1, 4, 1, 10),
    )


@pytest.mark.parametrize(
    ("text", "expected", "tree"),
    [
        ("", ["1:1 E0104"], "?"),
        ("a +", ["1:4 E0104"], "(a + ?)"),
        ("a + * b", ["1:5 E0104"], "((a + ?) * b)".replace("((a + ?) * b)", "(a + (? * b))")),
        ("(a + b", ["1:7 E0101"], "(a + b)"),
        ("a[1", ["1:4 E0101"], "a[1]"),
        ("a.", ["1:3 E0109"], "a."),
        ("a.;", ["1:3 E0109"], "a."),
        ("f(1 2)", ["1:5 E0101"], "f(1, 2)"),
        ("f(1,,2)", ["1:5 E0104"], "f(1, ?, 2)"),
        ("f(1", ["1:4 E0101"], "f(1)"),
        ("f(a := 1 b := 2)", ["1:10 E0101"], "f(a := 1, b := 2)"),
        ("[1, 2", ["1:6 E0101"], "[1, 2]"),
        ("a b", ["1:3 E0101"], "a"),
    ],
)
def test_faulty_expression_keeps_what_is_right(text: str, expected: list[str], tree: str) -> None:
    node, diagnostics = parse_expression(text)
    assert codes(diagnostics) == expected
    assert expression(node) == tree
