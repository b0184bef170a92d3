"""Proposals inside parentheses: the parameters of a call, the members of an initial value, whole calls."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from tappet.lang import types as t
from tappet.lang.lexer import ID
from tappet.lang.services import describe
from tappet.lang.services.cursor import EnclosingCall, chain_before, operand
from tappet.lang.services.resolution import Meaning, Scope, block_of, callable_pou, members, resolve
from tappet.lang.services.results import Completion, ItemKind
from tappet.lang.services.workspace import View
from tappet.lang.symbols import PouSymbol, Symbol, TypeSymbol, VarSymbol

_ARROWS = {"VAR_INPUT": ":=", "VAR_IN_OUT": ":=", "VAR_OUTPUT": "=>"}
_ORDER = {"VAR_INPUT": 0, "VAR_IN_OUT": 1, "VAR_OUTPUT": 2}


def ordered_pins(pou: PouSymbol) -> list[VarSymbol]:
    """Inputs, then in-outs, then outputs, each as declared."""
    return sorted(describe.pins(pou), key=lambda pin: _ORDER[pin.section])


def parameters(scope: Scope, call: EnclosingCall, first: bool) -> Iterator[Completion]:
    """The parameters that are not given yet; at the beginning of a call all of them at once as well."""
    pou = callable_pou(resolve(scope, call.callee))
    if pou is None:
        return
    pins = [pin for pin in ordered_pins(pou) if pin.name.upper() not in call.given]
    # Behind a parenthesis that is not closed yet, names of the next statements look like given ones.
    if first and len(pins) == len(ordered_pins(pou)) > 1:
        shown = ", ".join(f"{pin.name} {_ARROWS[pin.section]}" for pin in pins[:3])
        label = f"{shown}{', ...' if len(pins) > 3 else ''}"
        text = "All parameters of the call."
        insert = _arguments(pins)
        yield Completion(label, ItemKind.SNIPPET, pou.name, text, insert=insert, snippet=True, rank=0)
    for number, pin in enumerate(pins, 1):
        yield _named(pin, _ARROWS[pin.section], pin.section, 0, number)


def _named(variable: VarSymbol, arrow: str, section: str, rank: int, order: int) -> Completion:
    return Completion(
        f"{variable.name} {arrow}",
        ItemKind.PARAMETER,
        f"{section} {describe.type_as_written(variable)}".strip(),
        variable.comment,
        insert=f"{variable.name} {arrow} ",
        rank=rank,
        order=order,
        library=describe.library_of(variable),
    )


def _arguments(pins: Iterable[VarSymbol]) -> str:
    """`a := $1, b => $2` as a snippet."""
    parts = [f"{pin.name} {_ARROWS[pin.section]} ${number}" for number, pin in enumerate(pins, 1)]
    return ", ".join(parts)


def whole_call(symbol: Symbol, name: str, rank: int, statement: bool) -> Completion | None:
    """`fbDelay(IN := , PT := , Q => )` with a place for each parameter; None for what has none."""
    pou = symbol if isinstance(symbol, PouSymbol) else block_of(getattr(symbol, "type", None))
    if pou is None or (isinstance(symbol, PouSymbol) and pou.kind not in ("FUNCTION", "METHOD")):
        return None
    pins = ordered_pins(pou)
    if not pins:
        return None
    end = ");$0" if statement and pou.return_type is None else ")$0"
    return Completion(
        f"{name}(...)",
        ItemKind.SNIPPET,
        describe.short(symbol),
        describe.comment_of(symbol),
        insert=f"{name}({_arguments(pins)}{end}",
        snippet=True,
        rank=rank,
        order=1,
        library=describe.library_of(symbol),
    )


# -- initial values


def initial_members(view: View, scope: Scope, previous: int) -> Iterator[Completion]:
    """Members of the structure, or inputs of the block, whose value `:= (...)` holds the place."""
    lexed = view.lexed
    level = 0
    given: set[str] = set()
    at = previous
    while at > 0:
        kind = lexed.kinds[at]
        if kind in (")", "]"):
            level += 1
        elif kind in ("(", "["):
            if level == 0:
                break
            level -= 1
        elif kind == ":=" and level == 0 and lexed.kinds[at - 1] is ID:
            given.add(lexed.texts[at - 1].upper())
        elif kind == ";":
            return
        at -= 1
    if at < 2 or lexed.kinds[at] != "(" or lexed.kinds[at - 1] != ":=":
        return
    for number, (key, symbol) in enumerate(_parts(type_before(view, scope, at - 1)).items()):
        if key not in given and isinstance(symbol, VarSymbol) and symbol.section != "VAR_OUTPUT":
            yield _named(symbol, ":=", "", 0, number)


def _parts(type_: t.Type | None) -> dict[str, Symbol]:
    block = block_of(type_)
    if block is not None:
        return {pin.name.upper(): pin for pin in ordered_pins(block)}
    if isinstance(type_, t.Struct):
        return members(Meaning(None, type_))
    return {}


def type_before(view: View, scope: Scope, assignment: int) -> t.Type | None:
    """The type of what stands before the `:=` at a token: of a variable, or behind the colon."""
    lexed = view.lexed
    start = chain_before(lexed, assignment)
    if start == assignment:
        return None
    meaning = resolve(scope, operand(lexed, view.source, start, assignment))
    if start and lexed.kinds[start - 1] == ":" and start + 1 == assignment:
        name = lexed.texts[start].upper()
        return t.ELEMENTARY.get(name) or _named_type(meaning.symbol)
    return meaning.type or _named_type(meaning.symbol)


def _named_type(symbol: Symbol | None) -> t.Type | None:
    if isinstance(symbol, TypeSymbol):
        return symbol.type
    return symbol.instance if isinstance(symbol, PouSymbol) else None


# -- CASE


def case_selector(view: View, scope: Scope, previous: int) -> tuple[t.Enum, frozenset[str]] | None:
    """The enumeration by which the innermost open CASE selects, and the values that have a branch already."""
    lexed = view.lexed
    level = 0
    start = -1
    for at in range(previous, -1, -1):
        kind = lexed.kinds[at]
        if kind == "END_CASE":
            level += 1
        elif kind == "CASE":
            if level == 0:
                start = at
                break
            level -= 1
        elif kind.startswith(("VAR", "END_VAR")):
            return None
    if start < 0:
        return None
    of = next((at for at in range(start, previous + 1) if lexed.kinds[at] == "OF"), None)
    if of is None:
        return None
    type_ = resolve(scope, operand(lexed, view.source, start + 1, of)).type
    if not isinstance(type_, t.Enum):
        return None
    names = {name.upper() for name in type_.values}
    used = {
        lexed.texts[at].upper()
        for at in range(of, len(lexed.kinds) - 1)
        if lexed.texts[at].upper() in names and lexed.kinds[at + 1] in (":", ",", "..")
    }
    return type_, frozenset(used)


def argument_type(scope: Scope, call: EnclosingCall) -> t.Type | None:
    """The type of the parameter that stands at the place of an argument without a name."""
    pou = callable_pou(resolve(scope, call.callee))
    if pou is None or call.given:
        return None
    pins = list(describe.pins(pou))
    return pins[call.count].type if call.count < len(pins) else None
