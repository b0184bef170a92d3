"""Arguments of FB_Init: in the declaration of an instance, and in `__NEW(FB(...))` (LDEC-102)."""

from __future__ import annotations

from tappet.lang import ast
from tappet.lang.analysis.calls import bind_arguments, evaluate_arguments
from tappet.lang.analysis.context import Body
from tappet.lang.analysis.members import find_member
from tappet.lang.heritage import has_unknown_base
from tappet.lang.source import Span
from tappet.lang.symbols import PouSymbol, VarSymbol

_FIXED = 2
"""FB_Init begins with bInitRetains and bInCopyCode; the rest comes from the declaration."""


def bind_fb_init(b: Body, args: list[ast.Argument], block: PouSymbol, span: Span) -> list[VarSymbol]:
    """Connects the arguments of one instance, or of all elements of an array; the inputs that have none."""
    init = find_member(block, "FB_INIT")
    if init is None and has_unknown_base(block):
        evaluate_arguments(b, args)
        return []
    extra = init.parameters[_FIXED:] if isinstance(init, PouSymbol) else []
    if args:
        bind_arguments(b, args, extra, f"{block.name}.FB_Init", span, "FB_INIT")
    given = {id(a.parameter) for a in args}
    return [
        parameter
        for parameter in extra
        if parameter.section == "VAR_INPUT"
        and id(parameter) not in given
        and (parameter.decl is None or parameter.decl.initial is None)
    ]
