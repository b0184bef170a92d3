"""LLVM modules: partition of an application, declarations, globals, attributes, debug information."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from tappet.codegen.debug_info import DebugInfo, Metadata
from tappet.codegen.emit_calls import TABLE
from tappet.codegen.emit_function import FunctionEmitter, parameter_attributes
from tappet.codegen.emit_place import ModuleState
from tappet.codegen.emit_text import function_symbol, llvm_type, quoted, symbol
from tappet.core import ir

TRIPLE = "x86_64-unknown-linux-gnu"


@dataclass(frozen=True, slots=True)
class EmitOptions:
    """How code is emitted."""

    triple: str = TRIPLE
    absolute_data: bool = True
    """Data objects lie below 2 GiB: reach them with 32-bit immediates instead of through the GOT (x86-64)."""


_COMMON = 'nounwind null_pointer_is_valid "frame-pointer"="all" "probe-stack"="inline-asm"'
_ATTRIBUTES = f"""
attributes #0 = {{ {_COMMON} }}
attributes #1 = {{ cold nomerge noreturn nounwind }}
attributes #2 = {{ nounwind willreturn memory(none) }}
attributes #3 = {{ nounwind returns_twice }}
attributes #4 = {{ cold optsize noinline {_COMMON} }}
attributes #5 = {{ noinline {_COMMON} }}
attributes #6 = {{ alwaysinline {_COMMON} }}
attributes #7 = {{ returns_twice noinline {_COMMON} }}
attributes #8 = {{ noinline optnone }}
"""

_RUNTIME = {
    "tappet_fault": "declare void @tappet_fault(i32, i64, i64, i64) #1",
    "tappet_now_ns": "declare i64 @tappet_now_ns() nounwind",
    "strcmp": "declare i32 @strcmp(ptr, ptr) nounwind willreturn memory(argmem: read)",
    "tappet.wstrcmp": """
define internal i32 @tappet.wstrcmp(ptr %a, ptr %b) nounwind null_pointer_is_valid {
  br label %loop
loop:
  %p = phi ptr [%a, %0], [%p2, %next]
  %q = phi ptr [%b, %0], [%q2, %next]
  %x = load i16, ptr %p
  %y = load i16, ptr %q
  %same = icmp eq i16 %x, %y
  br i1 %same, label %next, label %differ
next:
  %p2 = getelementptr i8, ptr %p, i64 2
  %q2 = getelementptr i8, ptr %q, i64 2
  %end = icmp eq i16 %x, 0
  br i1 %end, label %equal, label %loop
equal:
  ret i32 0
differ:
  %xw = zext i16 %x to i32
  %yw = zext i16 %y to i32
  %d = sub i32 %xw, %yw
  ret i32 %d
}""",
}


def emit_module(
    module: ir.Module,
    names: list[str],
    options: EmitOptions,
    whole: bool,
    copies: Iterable[str] = (),
    used: set[str] | None = None,
    emitter: Callable[[ModuleState, ir.Function], FunctionEmitter] = FunctionEmitter,
) -> str:
    """LLVM text of the functions `names`; `whole` says that they are all there are.

    `copies` are functions of other modules that may be inlined here. `used` gets the symbols of the data and
    constants that the text refers to. `emitter` makes what emits each function.
    """
    metadata = Metadata()
    metadata.add('!{!"branch_weights", i32 1, i32 1048575}')
    metadata.add("!{}")
    absolute = metadata.add("!{i64 0, i64 2147483648}")
    debug = DebugInfo(metadata)
    state = ModuleState(module, metadata, debug)
    body: list[str] = []
    own = {*names, *copies}
    for name in names:
        function = module.functions[name]
        linkage = "" if function.exported else ("internal " if whole else "hidden ")
        body += emitter(state, function).text(linkage)
    for name in copies:
        function = module.functions[name]
        linkage = "available_externally " + ("" if function.exported else "hidden ")
        body += emitter(state, function).text(linkage)
    tables = _dispatch(module, state, whole, bool(own & _dispatch_home(module)))
    head = [f'target triple = "{options.triple}"']
    suffix = f", !absolute_symbol !{absolute}" if options.absolute_data else ""
    head += _globals(module, state, suffix)
    head += tables
    # the executive defines what other code only calls
    head += [_RUNTIME[name] for name in sorted((state.used & _RUNTIME.keys()) - own)]
    head += sorted(state.intrinsics)
    head += [_declaration(module, name) for name in sorted(state.called - own)]
    if used is not None:
        used |= state.used
    return "\n".join([*head, *body, _ATTRIBUTES, *debug.named(), *metadata.lines, ""])


def same_code(module: ir.Module, one: ir.Function, other: ir.Function) -> bool:
    """Whether two functions come to the same code, lines included, if what they call is the same."""
    if (one.exported, one.weight) != (other.exported, other.weight):
        return False
    texts = []
    for function in (one, other):
        metadata = Metadata()
        state = ModuleState(module, metadata, DebugInfo(metadata))
        text = FunctionEmitter(state, function).text("")
        constants = [module.constants[name].data for name in sorted(state.used) if name in module.constants]
        texts.append((text, metadata.lines, constants))
    return texts[0] == texts[1]


def _globals(module: ir.Module, state: ModuleState, suffix: str) -> list[str]:
    lines = []
    model = 'code_model "large", ' if suffix else ""
    for name in sorted(state.used):
        if name in module.data:
            size, align = module.data[name]
            lines.append(f"{symbol(name)} = external global [{size} x i8], {model}align {align}{suffix}")
        elif name in module.constants:
            const = module.constants[name]
            lines.append(
                f"{symbol(name)} = private unnamed_addr constant [{len(const.data)} x i8] "
                f'c"{quoted(const.data)}", align {const.align}'
            )
    for name, count in sorted(state.sites.items()):
        lines.append(f"{symbol(name)} = external global [{max(count, 1)} x i8], {model}align 1{suffix}")
    return lines


def _declaration(module: ir.Module, name: str) -> str:
    function = module.functions.get(name)
    if function is not None:
        parameters = ", ".join(llvm_type(p.type) + parameter_attributes(p) for p in function.parameters)
        hidden = "" if function.exported else "hidden "
        return f"declare {hidden}{llvm_type(function.result)} {function_symbol(function)}({parameters}) #0"
    external = module.externals[name]
    parameters = ", ".join(llvm_type(p) for p in external.parameters)
    attributes = "noreturn " if external.noreturn else ""
    attributes += "memory(none) willreturn " if external.pure else ""
    return f"declare {llvm_type(external.result)} {symbol(name)}({parameters}) {attributes}nounwind"


def _dispatch_home(module: ir.Module) -> set[str]:
    """The function whose module also holds the dispatch tables: the first one."""
    return {next(iter(module.functions))} if module.functions else set()


def _dispatch(module: ir.Module, state: ModuleState, whole: bool, home: bool) -> list[str]:
    """The method tables, one per slot: in the one module where they are used, or in the first of several."""
    entries: dict[int, dict[int, str]] = {}
    for block in module.dispatch:
        for slot, name in block.methods.items():
            entries.setdefault(slot, {})[block.type_id] = name
    highest = max((t.type_id for t in module.dispatch), default=0)
    slots = {*entries, *(method.slot for method in module.virtual.values())}
    lines = []
    for slot in sorted(slots):
        table = f"{TABLE}{slot}"
        numbers = entries.get(slot, {})
        if table in state.used and not whole and not home:
            lines.append(f"{symbol(table)} = external hidden constant [{highest + 1} x ptr]")
        elif table in state.used or (home and not whole):
            state.called.update(numbers.values())
            names = [numbers.get(number) for number in range(highest + 1)]
            bodies = (f"ptr {function_symbol(module.functions[n])}" if n else "ptr null" for n in names)
            linkage = "internal" if whole else "hidden"
            lines.append(f"{symbol(table)} = {linkage} constant [{highest + 1} x ptr] [{', '.join(bodies)}]")
    return lines
