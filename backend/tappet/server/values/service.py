"""Reading, writing and forcing variables of a running application by their paths."""

from __future__ import annotations

import math
from collections.abc import Awaitable, Callable, Iterable, Sequence
from dataclasses import dataclass
from itertools import islice
from typing import Any

from pydantic import JsonValue

from tappet.codegen.display import display_text
from tappet.codegen.symbol_map import SymbolError, SymbolMap, VarRef
from tappet.lang.nearest import nearest
from tappet.runtime.operations.flight import ReadFlight
from tappet.runtime.operations.instants import instant_of
from tappet.runtime.operations.values import Force, ListForces, Read, Unforce, Write
from tappet.server.auth.sent_from import SentFrom
from tappet.server.problems import Problem
from tappet.server.runtimes.links import RuntimeLink, path_of
from tappet.server.shapes import InvalidField
from tappet.server.values.shapes import ForcedValue, NewValue, Value

MAX_BYTES = 4 * 1024 * 1024
"""Memory read in one request."""
MOST_COMPARED = 1000
MOST_EXPLAINED = 20


@dataclass(frozen=True, slots=True)
class Written:
    """A value that is written, forced or released, for the audit log."""

    path: str
    old_literal: str
    new_literal: str


async def read(link: RuntimeLink, expressions: Sequence[str], *, cycle: int | None = None) -> list[Value]:
    """The values of one moment, the present or the end of a past cycle; an expression that has none carries
    its error."""
    symbols, code_id = link.loaded_symbols(), link.code_id
    found = resolve_all(symbols, expressions)
    refs = [ref for ref in found if isinstance(ref, VarRef)]
    data = iter(await _read_refs(link, code_id, refs, cycle))
    result = []
    for expression, ref in zip(expressions, found, strict=True):
        if isinstance(ref, str):
            result.append(Value(expression=expression, error=ref))
        else:
            value = _value(link, symbols, expression, ref, next(data))
            result.append(value if cycle is None else value.model_copy(update={"forced": False}))
    return result


Begin = Callable[[list[Written]], Awaitable[None]]
"""Called with what is to be written, right before it is; when it raises, nothing is."""


async def write(link: RuntimeLink, values: Sequence[NewValue], begin: Begin) -> None:
    """Writes all values at the beginning of one cycle, or none: raises a 422 problem if one is wrong."""
    await _set(link, values, begin)


async def force(
    link: RuntimeLink, values: Sequence[NewValue], begin: Begin, *, user: str, place: SentFrom
) -> None:
    """Forces all values; raises a 422 problem and forces none if one is wrong."""
    await _set(link, values, begin, force=(user, place))


async def unforce(
    link: RuntimeLink, expressions: Sequence[str] | None, begin: Begin, *, restore: bool = False
) -> None:
    """Releases forced variables, all with None; with `restore` they get back what they held before."""
    symbols, code_id = link.loaded_symbols(), link.code_id
    if expressions is None:
        places = None
        released = dict(link.forced)
    else:
        refs = [_resolve_or_refuse(symbols, expression) for expression in expressions]
        places = [(ref.offset, ref.bit) for ref in refs]
        released = {place: link.forced[place] for place in places if place in link.forced}
    before = {v.expression: v.literal or "" for v in await forces(link)}
    await begin([Written(path, before.get(path, ""), "") for path in released.values()])
    async with link.client() as client:
        await client.call(Unforce(places, restore, code_id))
    await link.refresh()


async def forces(link: RuntimeLink) -> list[ForcedValue]:
    """The forced variables with the values they are held at, and where the forces come from."""
    symbols = link.loaded_symbols()
    async with link.client() as client:
        forced = await client.call(ListForces())
    result = []
    for force in forced:
        path = path_of(force)
        ref = try_resolve(symbols, path)
        origin: dict[str, Any] = {
            "user": force.user,
            "source": force.source,
            "program": force.program,
            "address": force.address,
            "at": instant_of(force.at_ns) if force.at_ns else None,
        }
        if isinstance(ref, str):
            result.append(ForcedValue(expression=path, forced=True, error=ref, **origin))
        else:
            value = _value(link, symbols, path, ref, _in_place(ref, force.data)).model_dump()
            before = _literal(symbols, ref, _in_place(ref, force.before))
            result.append(ForcedValue(**(value | {"forced": True, "before": before} | origin)))
    return result


def explain(symbols: SymbolMap, expression: str, error: SymbolError) -> str:
    """The error of an expression, with the names that may have been meant."""
    near = suggest(symbols, expression)
    if not near:
        return f"{error}."
    names = " or ".join(f"'{name}'" for name in near)
    return f"{error}. Did you mean {names}?"


def suggest(symbols: SymbolMap, expression: str) -> list[str]:
    """Up to three existing paths like `expression`, which is wrong in its last resolvable step."""
    steps = [step.strip() for step in expression.split(".")]
    for length in range(len(steps) - 1, -1, -1):
        prefix = ".".join(steps[:length])
        wrong = steps[length].partition("[")[0].upper()
        try:
            if prefix and prefix.upper() not in symbols.roots and symbols.resolve(prefix).type.leaf:
                return []
            names = {child.name.upper(): child.path for child in symbols.children(prefix)}
        except SymbolError:
            continue
        if not prefix:
            names |= {name: name for name in symbols.globals}
        if wrong in names:
            return []
        near = nearest(wrong, islice(names, MOST_COMPARED), 3)
        return [".".join([names[name], *steps[length + 1 :]]) for name in near]
    return []


def resolve_all(symbols: SymbolMap, expressions: Sequence[str]) -> list[VarRef | str]:
    """Like `try_resolve` for each; only the first unknown ones get suggestions, which take their time."""
    found: list[VarRef | str] = []
    unknown = 0
    for expression in expressions:
        try:
            found.append(symbols.resolve(expression))
        except SymbolError as error:
            unknown += 1
            found.append(explain(symbols, expression, error) if unknown <= MOST_EXPLAINED else f"{error}.")
    return found


def try_resolve(symbols: SymbolMap, expression: str) -> VarRef | str:
    """The variable, or the sentence that says why there is none."""
    try:
        return symbols.resolve(expression)
    except SymbolError as error:
        return explain(symbols, expression, error)


def json_value(value: Any) -> Any:
    """The value as JSON can carry it: what is no finite number becomes null (the literal says what it is)."""
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, list):
        return [json_value(item) for item in value]
    if isinstance(value, dict):
        return {name: json_value(item) for name, item in value.items()}
    return value


# -- details ------------------------------------------------------------------------------------------


async def _set(
    link: RuntimeLink,
    values: Sequence[NewValue],
    begin: Begin,
    *,
    force: tuple[str, SentFrom] | None = None,
) -> None:
    """Writes values, or forces them with the user and the source of the order."""
    symbols, code_id = link.loaded_symbols(), link.code_id
    orders: list[tuple[VarRef, bytes]] = []
    errors: list[InvalidField] = []
    for wanted in values:
        try:
            ref = symbols.resolve(wanted.expression)
            _check_writable(ref)
            orders.append((ref, symbols.encode(ref, wanted.value)))
        except SymbolError as error:
            said = explain(symbols, wanted.expression, error)
            errors.append(InvalidField(location=wanted.expression, message=said))
        except ValueError as error:
            errors.append(InvalidField(location=wanted.expression, message=f"{error}."))
    if errors:
        raise _refusal(errors)
    old = await _read_refs(link, code_id, [ref for ref, _ in orders])
    batch = [(ref.offset, data, ref.bit) for ref, data in orders]
    await begin(
        [
            Written(ref.path, _literal(symbols, ref, before), _literal(symbols, ref, _in_place(ref, data)))
            for (ref, data), before in zip(orders, old, strict=True)
        ]
    )
    async with link.client() as client:
        if force is None:
            await client.call(Write(batch, code_id))
        else:
            user, sent = force
            await client.call(Force(batch, user, sent.source, sent.program, sent.address, code_id))
    if force is not None:
        await link.refresh()


def _check_writable(ref: VarRef) -> None:
    if "CONSTANT" in ref.flags:
        raise ValueError(f"{ref.path} is a constant and cannot be written")
    if ref.section == "VAR_IN_OUT" or ref.type.kind in ("reference", "interface"):
        raise ValueError(
            f"{ref.path} refers to another variable ({ref.type.name}); write that variable instead"
        )


def _refusal(errors: list[InvalidField]) -> Problem:
    more = f" ({len(errors)} values are wrong)" if len(errors) > 1 else ""
    detail = f"{errors[0].location}: {errors[0].message}{more} Nothing was written."
    return Problem(422, "values-refused", detail, errors=errors)


def _resolve_or_refuse(symbols: SymbolMap, expression: str) -> VarRef:
    found = try_resolve(symbols, expression)
    if isinstance(found, str):
        raise _refusal([InvalidField(location=expression, message=found)])
    return found


async def _read_refs(
    link: RuntimeLink, code_id: str, refs: Iterable[VarRef], cycle: int | None = None
) -> list[bytes]:
    places = [(ref.offset, ref.size) for ref in refs]
    total = sum(size for _, size in places)
    if total > MAX_BYTES:
        raise Problem(413, "too-much-memory", f"{total} bytes in one request; at most {MAX_BYTES} are read.")
    if not places:
        return []
    async with link.client() as client:
        return await client.call(
            Read(places, code_id) if cycle is None else ReadFlight(cycle, places, code_id)
        )


def _value(link: RuntimeLink, symbols: SymbolMap, expression: str, ref: VarRef, data: bytes) -> Value:
    is_enum = ref.bit is None and ref.type.kind == "enum"
    return Value(
        expression=expression,
        type=ref.type.name,
        kind="bool" if ref.bit is not None else ref.type.kind,
        size=ref.size,
        enum=dict(ref.type.values) if is_enum else None,
        base=ref.type.base if is_enum else None,
        value=_json(symbols, ref, data),
        literal=_literal(symbols, ref, data),
        forced=(ref.offset, ref.bit) in link.forced,
    )


def _json(symbols: SymbolMap, ref: VarRef, data: bytes) -> JsonValue:
    value: JsonValue = json_value(symbols.decode(ref, data))
    return value


def _literal(symbols: SymbolMap, ref: VarRef, data: bytes) -> str:
    return display_text(symbols, ref, symbols.decode(ref, data))


def _in_place(ref: VarRef, data: bytes) -> bytes:
    """What the image will hold: for a bit, the byte with this bit set as ordered."""
    return data if ref.bit is None else bytes([(data[0] & 1) << ref.bit])
