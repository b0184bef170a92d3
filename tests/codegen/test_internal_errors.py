"""A failure of the compiler ends in a message that names the object and the line, in every stage."""

from __future__ import annotations

from typing import Any

import pytest

from tappet.codegen import emit_expression, emit_function
from tappet.codegen.build import BuildOptions, BuildSession, build_application
from tappet.codegen.compile_options import LlvmError, OptimiseOptions
from tappet.codegen.optimise import compile_text
from tappet.core import ir, passes, statements
from tappet.core.templates import Initialiser
from tappet.lang import ast
from tappet.lang.diagnostics import Diagnostic
from tappet.lang.source import Source

TEXT = """PROGRAM PLC_PRG
VAR n : INT; fb : FB_Leaf; END_VAR
n := n + 1;
fb();
END_PROGRAM
"""
LEAF = """FUNCTION_BLOCK FB_Leaf
VAR i, m : INT; s : STRING := 'x'; END_VAR
FOR i := 1 TO 3 DO
    m := m * 3;
END_FOR
END_FUNCTION_BLOCK
"""


def build(session: BuildSession | None = None, leaf: str = LEAF) -> list[Diagnostic]:
    result = build_application(
        [Source("plc", TEXT), Source("leaf", leaf)], (), BuildOptions(libraries=()), session=session
    )
    errors = [d for d in result.diagnostics if d.severity == "error"]
    assert (result.package is None) == bool(errors)
    return errors


def test_lowering(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: Any) -> None:
        raise KeyError("broken")

    monkeypatch.setitem(statements._STATEMENTS, ast.For, fail)
    (error,) = build()
    assert (error.code, error.uri, error.span.line) == ("E0905", "leaf", 2)
    assert error.message == "The compiler failed at 'FB_Leaf' (lowering): KeyError: 'broken'"


def test_initial_values(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: Any) -> None:
        raise RecursionError

    monkeypatch.setattr(Initialiser, "of_type", fail)
    (error,) = build()
    assert (error.code, error.uri, error.span.line) == ("E0905", "plc", 0)
    assert "'PLC_PRG' (initial values): RecursionError" in error.message


def test_passes(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: Any) -> None:
        raise ZeroDivisionError("division by zero")

    monkeypatch.setattr(passes, "mark_fixed_counters", fail)
    (error,) = build()
    assert (error.code, error.uri, error.span.line) == ("E0905", "leaf", 0)


def test_emission(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: Any) -> None:
        raise AssertionError

    monkeypatch.setitem(emit_function.FunctionEmitter.handlers, ir.For, fail)
    (error,) = build()
    assert (error.code, error.uri, error.span.line) == ("E0905", "leaf", 2)
    assert error.message.endswith("(code generation): AssertionError")


def wrong_type(emitter: Any, e: ir.Binary) -> str:
    """An instruction that LLVM refuses."""
    number = getattr(e.right, "value", 0)
    return str(emitter.value(f"mul i16 1.5, ptr null ; {number}")) if e.op == "mul" else "0"


def test_llvm(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(emit_expression._HANDLERS, ir.Binary, wrong_type)
    (error,) = build()
    assert (error.code, error.uri, error.span.line) == ("E0905", "leaf", 3)
    assert "'FB_Leaf' (machine code): LLVM IR parsing error" in error.message


def test_a_session_goes_on_after_a_failure(monkeypatch: pytest.MonkeyPatch) -> None:
    """The next build of the session makes everything again."""
    session = BuildSession()
    assert build(session) == []
    with monkeypatch.context() as inside:
        inside.setitem(emit_expression._HANDLERS, ir.Binary, wrong_type)
        (error,) = build(session, LEAF.replace("3;", "7;"))
        assert (error.uri, error.span.line) == ("leaf", 3)
    assert build(session, LEAF.replace("3;", "5;")) == []


def test_other_failures_are_told_too(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: Any) -> None:
        raise OSError("no space left")

    monkeypatch.setattr("tappet.codegen.generate.build_symbol_map", fail)
    (error,) = build()
    assert error.message == "The compiler failed at 'Application' (code generation): OSError: no space left"


def test_llvm_keeps_what_it_refused() -> None:
    with pytest.raises(LlvmError) as raised:
        compile_text("define i32 @f() {\nret ptr null\n}\n", OptimiseOptions())
    assert raised.value.text.startswith("define")
