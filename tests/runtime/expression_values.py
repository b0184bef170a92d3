"""Evaluates expressions against a loaded application, as the executive does it in a cycle."""

from __future__ import annotations

from tappet.codegen.expressions.compiler import compile_expression
from tappet.runtime.expressions import NativeExpression, evaluate, memory_of
from tappet.runtime.local import LocalRuntime


def value_now(runtime: LocalRuntime, text: str) -> bool | int | float | None:
    application = runtime.plc.application
    assert application is not None
    program = compile_expression(text, application.package.symbols)
    native = NativeExpression(runtime.plc.executive, program, application.image.size)
    return evaluate(runtime.plc.executive, native, memory_of(application))
