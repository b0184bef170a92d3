"""Any text gives a tree: generated programs come back equal, damaged and hostile ones end in messages."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from st_text import body_of, expression, same, statements, type_text

from tappet.iec.words import KEYWORDS
from tappet.lang import ast
from tappet.lang.lexer import tokenize
from tappet.lang.parser import parse, parse_expression
from tappet.lang.source import Source

names = st.sampled_from(["a", "bVar", "FB_x", "_q", "S", "R", "by", "Get", "INT", "x1"])
literals = st.sampled_from(
    [("int", "0", 0), ("int", "16#FF", 255), ("real", "1.5e3", 1500.0), ("time", "T#5s", 5000),
     ("bool", "TRUE", True), ("string", "'a$'b'", b"a'b")]
).map(lambda item: ast.Literal(kind=item[0], text=item[1], value=item[2]))  # fmt: skip
ONE = ast.Literal(kind="int", text="1", value=1)
OPERATORS = [
    "+",
    "-",
    "*",
    "/",
    "MOD",
    "**",
    "AND",
    "OR",
    "XOR",
    "AND_THEN",
    "OR_ELSE",
    "=",
    "<>",
    "<",
    ">",
    "<=",
    ">=",
]


def variables() -> st.SearchStrategy[ast.Expr]:
    base = st.one_of(
        names.map(lambda name: ast.Name(name=name)),
        names.map(lambda name: ast.Name(name=name, leading_dot=True)),
        st.just(ast.Deref(base=ast.This())),
    )
    whole = st.recursive(
        base,
        lambda inner: st.one_of(
            st.builds(lambda b, n: ast.Member(base=b, name=n), inner, st.sampled_from(["m", "Set", "IF"])),
            st.builds(
                lambda b, i: ast.Index(base=b, indices=i), inner, st.lists(inner, min_size=1, max_size=2)
            ),
            st.builds(lambda b: ast.Deref(base=b), inner),
        ),
        max_leaves=4,
    )
    return st.one_of(whole, whole.map(lambda b: ast.Member(base=b, name="3")))


def expressions() -> st.SearchStrategy[ast.Expr]:
    def grown(inner: st.SearchStrategy[ast.Expr]) -> st.SearchStrategy[ast.Expr]:
        argument = st.one_of(
            st.builds(lambda v: ast.Argument(name=None, value=v), inner),
            st.builds(lambda n, v: ast.Argument(name=n, value=v), names, st.one_of(st.none(), inner)),
            st.builds(lambda n, v: ast.Argument(name=n, value=v, output=True), names, variables()),
        )
        return st.one_of(
            st.builds(
                lambda o, a, b: ast.Binary(op=o, left=a, right=b), st.sampled_from(OPERATORS), inner, inner
            ),
            st.builds(lambda o, a: ast.Unary(op=o, operand=a), st.sampled_from(["-", "+", "NOT"]), inner),
            st.builds(lambda c, a: ast.Call(callee=c, args=a), variables(), st.lists(argument, max_size=3)),
        )

    return st.recursive(
        st.one_of(literals, variables(), st.just(ast.Name(name="%IX0.0"))), grown, max_leaves=12
    )


def programs() -> st.SearchStrategy[list[ast.Stmt]]:
    value = expressions()
    simple = st.one_of(
        st.builds(
            lambda o, t, v: ast.Assign(op=o, target=t, value=v),
            st.sampled_from([":=", "S=", "R=", "REF="]), variables(), value,
        ),
        st.builds(lambda c: ast.CallStmt(call=ast.Call(callee=c, args=[])), variables()),
        st.sampled_from([ast.Exit(), ast.Continue(), ast.Return(), ast.Empty(), ast.Jump(target="l")]),
        st.builds(lambda t: ast.Assign(op=":=", target=t, value=ONE, label="l"),
                  variables()),
    )  # fmt: skip

    def grown(inner: st.SearchStrategy[ast.Stmt]) -> st.SearchStrategy[ast.Stmt]:
        body = st.lists(inner, max_size=3)
        selector = st.builds(
            lambda low, high: ast.CaseRange(low=low, high=high), literals, st.one_of(st.none(), literals)
        )
        # a name before ':' is a CASE label there, never a jump label
        plain = body.map(lambda found: [replace(item, label=None) for item in found])
        branch = st.builds(
            lambda s, b: ast.CaseBranch(selectors=s, body=b),
            st.lists(selector, min_size=1, max_size=3),
            plain,
        )
        return st.one_of(
            st.builds(
                lambda b, o: ast.If(branches=b, otherwise=o),
                st.lists(st.tuples(value, body), min_size=1, max_size=3), st.one_of(st.none(), body),
            ),
            st.builds(
                lambda s, b, o: ast.Case(selector=s, branches=b, otherwise=o),
                value, st.lists(branch, max_size=3), st.one_of(st.none(), body),
            ),
            st.builds(
                lambda v, a, b, c, d: ast.For(variable=v, start=a, stop=b, step=c, body=d),
                variables(), value, value, st.one_of(st.none(), value), body,
            ),
            st.builds(lambda c, b: ast.While(condition=c, body=b), value, body),
            st.builds(lambda c, b: ast.RepeatUntil(condition=c, body=b), value, body),
        )  # fmt: skip

    return st.lists(st.recursive(simple, grown, max_leaves=8), max_size=4)


def types() -> st.SearchStrategy[ast.TypeRef]:
    base = st.one_of(
        st.sampled_from(["INT", "Lib.FB", "T_x"]).map(lambda name: ast.NamedType(name=name)),
        st.builds(
            lambda w, n: ast.StringType(wide=w, length=n), st.booleans(), st.one_of(st.none(), literals)
        ),
        st.builds(lambda a, b: ast.SubrangeType(base="INT", low=a, high=b), literals, literals),
        st.lists(names, min_size=1, max_size=3).map(
            lambda found: ast.EnumType(values=[ast.EnumValue(name=name) for name in found])
        ),
    )
    bound = st.one_of(st.just((None, None)), st.tuples(literals, literals))
    return st.recursive(
        base,
        lambda inner: st.one_of(
            st.builds(lambda t: ast.PointerType(base=t), inner),
            st.builds(lambda t: ast.ReferenceType(base=t), inner),
            st.builds(
                lambda b, t: ast.ArrayType(bounds=b, element=t),
                st.lists(bound, min_size=1, max_size=3),
                inner,
            ),
            st.builds(
                lambda m, u: ast.StructType(members=[ast.VarDecl(name="x", type_ref=t) for t in m], union=u),
                st.lists(inner, max_size=3), st.booleans(),
            ),
        ),
        max_leaves=6,
    )  # fmt: skip


@given(expressions())
def test_expression_comes_back_from_its_text(tree: ast.Expr) -> None:
    read, diagnostics = parse_expression(expression(tree))
    assert diagnostics == []
    assert same(read, tree), expression(read)


@settings(suppress_health_check=[HealthCheck.too_slow])
@given(programs())
def test_program_comes_back_from_its_text(body: list[ast.Stmt]) -> None:
    text = statements(body)
    assert same(body_of(text), body), text


@given(types())
def test_type_comes_back_from_its_text(tree: ast.TypeRef) -> None:
    result = parse(Source("x", f"TYPE T : {type_text(tree)}; END_TYPE"))
    assert result.diagnostics == []
    (decl,) = result.unit.declarations
    assert isinstance(decl, ast.TypeDecl)
    assert same(decl.type_ref, tree)


PROGRAM = """
{attribute 'x' := 'y'}
(* Motor *)
FUNCTION_BLOCK FB_Motor EXTENDS Base IMPLEMENTS IA, IB
VAR_INPUT xOn : BOOL := TRUE; (* on *) END_VAR
VAR aX : ARRAY[0..3] OF INT := [1, 3(7)]; p AT %IX0.0 : BOOL; s : STRING(20) := 'a$'b'; END_VAR
VAR f : FB(1, x := 2); END_VAR
METHOD PUBLIC Start : BOOL VAR_INPUT v : REAL; END_VAR Start := v > 1.5E3; END_METHOD
IF xOn AND NOT (aX[1] <> 16#FF) THEN
    aX[0] := -aX[1] ** 2 + SHL(3, n := 1) MOD 4; // shift
ELSIF a THEN f(x := 1, y => b); ELSE RETURN; END_IF;
CASE aX[0] OF 1, 3..5: a S= b; Red: JMP l; ELSE ; END_CASE
FOR i := 1 TO 10 BY 2 DO EXIT; END_FOR WHILE p^ DO CONTINUE; END_WHILE
REPEAT l: x := y := THIS^.z; UNTIL T#5s > t END_REPEAT
{IF defined (x)} __TRY a(); __CATCH(e) __FINALLY __ENDTRY {END_IF}
PROPERTY P : INT GET P := 1; END_GET SET a := P; END_SET END_PROPERTY
ACTION Act x := 1; END_ACTION
END_FUNCTION_BLOCK
TYPE E : (a, b := 5) BYTE := b; S : STRUCT x : INT(1..5); END_STRUCT END_TYPE
VAR_GLOBAL RETAIN g : POINTER TO REFERENCE TO WSTRING; END_VAR
INTERFACE I EXTENDS J METHOD m : INT END_METHOD END_INTERFACE
"""
PIECES = [token.text for token in tokenize(Source("x", PROGRAM))]
WORDS = (
    sorted(KEYWORDS)
    + sorted(set(PIECES))
    + ["GET", "SET", "(*", "*)", "'", '"', "{", "}", "$", "\x00", "\n", "#"]
)


def test_the_sample_itself_is_right() -> None:
    assert parse(Source("x", PROGRAM)).diagnostics == []


@given(st.lists(st.sampled_from(WORDS), max_size=60), st.booleans())
def test_any_words_give_a_tree(words: list[str], child: bool) -> None:
    parse(Source("x", " ".join(words), owner="FB" if child else None, name="Act" if child else None))


@given(
    st.lists(
        st.tuples(
            st.integers(0, len(PIECES) - 1),
            st.sampled_from(["drop", "double", "put"]),
            st.sampled_from(WORDS),
        ),
        max_size=6,
    ),
    st.sampled_from([" ", "\n"]),
)
def test_damaged_programs_give_a_tree(damage: list[tuple[int, str, str]], blank: str) -> None:
    pieces = list(PIECES)
    for index, how, word in damage:
        pieces[index] = {"drop": "", "double": f"{pieces[index]} {pieces[index]}", "put": word}[how]
    text = blank.join(f"{piece}\n" if piece.startswith("//") else piece for piece in pieces)
    result = parse(Source("x", text))
    lines = text.count("\n") + 1
    for diagnostic in result.diagnostics:
        assert 0 <= diagnostic.span.line < lines
        assert diagnostic.message


@given(st.text(max_size=200))
def test_any_characters_give_a_tree(text: str) -> None:
    parse(Source("x", text))


@given(st.binary(max_size=200))
def test_any_bytes_give_a_tree(data: bytes) -> None:
    parse(Source("x", data.decode("latin-1")))


N = 20_000


@pytest.mark.parametrize(
    ("text", "code"),
    [
        (f"a := {'(' * N}1{')' * N};", "E0107"),
        (f"a := {'(' * N}", "E0107"),
        (f"a := {'a[' * N}1{']' * N};", "E0107"),
        (f"a := {'f(' * N}1{')' * N};", "E0107"),
        (f"a := {'-' * N}1;", "E0107"),
        (f"a := {'NOT ' * N}1;", "E0107"),
        (f"{'a := ' * N}1;", "E0107"),
        (f"a := {'a + ' * N}1;", "E0107"),
        (f"a := {'x(1, ' * 50}{'a + ' * N}1;", "E0101"),
        (f"a{'.a' * N} := 1;", "E0107"),
        (f"f({'a + ' * N}1);", "E0107"),
        (f"f({'[' * N});", "E0107"),
        (f"f(a := {'(a := ' * N});", "E0107"),
        (f"a := [{'3(' * N}];", "E0107"),
        (f"{'IF a THEN ' * N}{'END_IF ' * N}", "E0107"),
        (f"{'IF a THEN ' * N}", "E0107"),
        (f"{'CASE a OF 1: ' * N}", "E0107"),
        (f"{'REPEAT ' * N}", "E0107"),
        (f"CASE a OF {'a' + '+a' * N}: b(); END_CASE", "E0107"),
    ],
)
def test_excessive_nesting_is_an_error_not_a_crash(text: str, code: str) -> None:
    result = parse(Source("x", f"PROGRAM p\n{text}\nEND_PROGRAM"))
    assert code in {d.code for d in result.diagnostics}
    assert len(result.diagnostics) <= 2


@pytest.mark.parametrize(
    "text",
    [
        f"PROGRAM p VAR a : {'ARRAY[1..2] OF ' * N}INT; END_VAR END_PROGRAM",
        f"PROGRAM p VAR a : {'POINTER TO ' * N}INT; END_VAR END_PROGRAM",
        f"PROGRAM p VAR a : T := {'[' * N}; END_VAR END_PROGRAM",
        f"TYPE T : {'STRUCT a : ' * N}",
        f"PROGRAM p VAR a : INT := {'a + ' * N}1; END_VAR END_PROGRAM",
        f"FUNCTION_BLOCK f {'METHOD m ' * N}",
        "(* " * N,
        "{" * N,
        "'" * N,
        f"PROGRAM p CASE a OF {'a,' * N}",
        f"PROGRAM p {'ELSE ' * N}",
    ],
)
def test_hostile_texts_end_in_a_message(text: str) -> None:
    assert parse(Source("x", text)).diagnostics


def test_long_flat_texts_are_no_error() -> None:
    body = "a := f(" + "1, " * N + "1);" + "a := b;" * N + "IF a THEN " + "ELSIF b THEN " * 900 + "END_IF"
    assert parse(Source("x", f"PROGRAM p {body} END_PROGRAM")).diagnostics == []


def test_a_chain_of_two_hundred_operands_is_no_error() -> None:
    assert parse_expression(" OR ".join(f"xAlarm{n}" for n in range(200)))[1] == []
