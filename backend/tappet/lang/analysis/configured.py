"""Places of variables with an incomplete address `%I*`: those of VAR_CONFIG, and free ones for the others.

A variable that VAR_CONFIG does not name is an error (LDEC-94), or gets the next free bytes behind all fixed
addresses of its area, in the order of the declarations, as TwinCAT does (`AnalysisOptions.free_addresses`).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis import addresses, layout
from tappet.lang.analysis.collected import Collected
from tappet.lang.analysis.context import Body, Session
from tappet.lang.analysis.declarations import Declarations
from tappet.lang.analysis.heads import plain_body
from tappet.lang.analysis.result import AGREED, ConfiguredAddress
from tappet.lang.diagnostics import Related
from tappet.lang.parts import Part, stored, types_holding, variables_of, walk
from tappet.lang.source import Scope
from tappet.lang.symbols import GvlSymbol, PouSymbol, Storage, VarSymbol

_CHANNEL_BYTES = 8
"""Room for what an address of several levels names: the widest channel."""
_LISTED = 20
"""Variables that the message about free places lists."""


@dataclass(frozen=True, slots=True)
class _Incomplete:
    """One instance of a variable with an incomplete address."""

    variable: VarSymbol
    owner: str
    """Data object it lies in."""
    offset: int
    path: str


def place_incomplete(session: Session, found: Collected, declarations: Declarations) -> None:
    """Gives every variable with an incomplete address its place: see `Analysis.configured`."""
    _place_all(session, found, declarations)
    _remember_markers(session)


def _remember_markers(session: Session) -> None:
    """Room for the values that markers and their variables have agreed on (LDEC-58)."""
    analysis = session.analysis
    agreed = GvlSymbol(AGREED, qualified_only=True)
    placement = layout.Placement()
    for number, item in enumerate(analysis.configured):
        if item.area != "M":
            continue
        bytes_ = t.Array(t.BYTE, ((0, max(item.type.size, 1) - 1),))
        offset = placement.place(bytes_.size, max(item.type.align, 1))
        variable = VarSymbol(
            item.path,
            type=bytes_,
            storage=Storage.GLOBAL,
            home=Storage.GLOBAL,
            section="VAR_GLOBAL",
            owner=AGREED,
            offset=offset,
        )
        agreed.members[item.path.upper()] = variable
        analysis.configured[number] = replace(item, agreed=offset)
    agreed.size = placement.size
    analysis.gvls = [gvl for gvl in analysis.gvls if gvl.name != AGREED]
    if agreed.members:
        analysis.gvls.append(agreed)


def _place_all(session: Session, found: Collected, declarations: Declarations) -> None:
    incomplete = _instances(session, found)
    session.analysis.configured = []
    seen: set[str] = set()
    for decl, source in found.configured:
        body = plain_body(session, source)
        type_ = declarations.type_of(body, decl.type_ref, decl.name)
        key = _key_of(decl.name, incomplete, found)
        if key in seen:
            body.report("E0610", decl.span, path=decl.name)
            continue
        seen.add(key)
        entry = incomplete.get(key)
        if entry is None:
            body.report("E0606", decl.name_span, path=decl.name, hint=_path_hint(key, incomplete))
            continue
        _connect(body, decl, entry, type_)
    left = [entry for key, entry in incomplete.items() if key not in seen]
    if left and session.options.free_addresses:
        _allocate(session, found, left)
        return
    for entry in left:
        variable = entry.variable
        if variable.source is not None and variable.span is not None:
            session.report("E0605", variable.source.uri, variable.span, path=entry.path)


def _key_of(path: str, incomplete: dict[str, _Incomplete], found: Collected) -> str:
    """The path in upper case; of `.name` that of the global variable, whichever list holds it."""
    key = path.upper()
    if not key.startswith("."):
        return key
    names = (f"{gvl.name.upper()}{key}" for gvl, _ in found.gvls if not gvl.qualified_only)
    return next((name for name in names if name in incomplete), key)


def _path_hint(key: str, incomplete: dict[str, _Incomplete]) -> str:
    tail = key.rpartition(".")[2]
    known = [entry.path for k, entry in incomplete.items() if k.endswith(f".{tail}")]
    return f"Paths with an incomplete address are: {', '.join(known[:3])}." if known else ""


def _connect(body: Body, decl: ast.VarDecl, entry: _Incomplete, type_: t.Type | None) -> None:
    variable = entry.variable
    if decl.address is None:
        body.report("E0601", decl.span, address="")
        return
    place = addresses.locate(body, decl.address, decl.span)
    if isinstance(place, addresses.IncompleteAddress):
        body.report("E0608", decl.span)
        return
    if place is None or type_ is None or variable.type is None:
        return
    if place.area != variable.area or type_ != variable.type:
        body.report(
            "E0607",
            decl.span,
            path=decl.name,
            declared=f"%{variable.area}* : {variable.type}",
            configured=f"{decl.address} : {type_}",
        )
        return
    owner = entry.owner.upper()
    body.session.analysis.configured.append(
        ConfiguredAddress(entry.path, owner, entry.offset, type_, place.area, place.offset, place.bit)
    )


# -- free places ------------------------------------------------------------------------------------


def _allocate(session: Session, found: Collected, left: list[_Incomplete]) -> None:
    """Places the variables without a line of VAR_CONFIG and says so once for each text that declares some."""
    ends = _fixed_ends(session, found)
    byte_mode = session.options.byte_addressing
    placed: dict[str, list[tuple[_Incomplete, str]]] = {}
    channels: dict[str, int] = {}
    for entry in left:
        variable = entry.variable
        type_, area, source, span = variable.type, variable.area, variable.source, variable.span
        if type_ is None or area is None or source is None or span is None:
            continue
        channel = _channel(variable)
        size = type_.size if channel is None else max(type_.size, _CHANNEL_BYTES)
        step = max(type_.align, 1) if channel is None else _CHANNEL_BYTES
        offset = (ends[area] + step - 1) // step * step
        if channel is not None:
            offset = channels.setdefault(channel, offset)
        address = addresses.text_of_place(area, offset, type_, byte_mode)
        limit = session.options.area_limits[area]
        if offset + type_.size > limit:
            session.report("E0604", source.uri, span, address=address, limit=limit)
            continue
        ends[area] = max(ends[area], offset + size)
        session.analysis.configured.append(
            ConfiguredAddress(entry.path, entry.owner.upper(), entry.offset, type_, area, offset, None)
        )
        placed.setdefault(source.uri, []).append((entry, address))
    for uri, entries in placed.items():
        (first, address), others = entries[0], entries[1:]
        assert first.variable.span is not None
        more = f" and {len(others)} more" if others else ""
        related = [
            Related(f"'{entry.path}' lies at {where}", uri, entry.variable.span)
            for entry, where in others[:_LISTED]
            if entry.variable.span is not None
        ]
        session.report(
            "W1303", uri, first.variable.span, related, path=first.path, address=address, more=more
        )


def _channel(variable: VarSymbol) -> str | None:
    """The address of several levels that a variable is declared at: all variables there share one place."""
    address = variable.decl.address if variable.decl is not None else None
    return address.upper() if address and not address.endswith("*") else None


def _fixed_ends(session: Session, found: Collected) -> dict[str, int]:
    """The byte behind the last fixed address of each area: of declarations, operands and VAR_CONFIG."""
    ends = dict.fromkeys("IQM", 0)

    def reach(area: str | None, end: int) -> None:
        if area is not None:
            ends[area] = max(ends[area], end)

    declared = [v for gvl, _ in found.gvls for v in gvl.members.values()]
    declared += [v for own in found.own.values() for v in own.variables.values()]
    for variable in declared:
        if variable.home is Storage.DIRECT and variable.type is not None:
            reach(variable.area, variable.offset + variable.type.size)
    for item in session.analysis.configured:
        reach(item.area, item.address + item.type.size)
    for area, end in session.operands:
        reach(area, end)
    return ends


# -- instances --------------------------------------------------------------------------------------


def _instances(session: Session, found: Collected) -> dict[str, _Incomplete]:
    """Every instance of a variable with an incomplete address, by upper-case path."""
    paths: dict[str, _Incomplete] = {}
    if not any(record.incomplete for record in session.declared.values()):
        return paths
    holding = types_holding(lambda type_: any(_incomplete(m.decl) is not None for m in stored(type_)))

    def collect(owner: PouSymbol | GvlSymbol, name: str) -> None:
        def visit(part: Part) -> bool:
            variable = _incomplete(part.decl)
            if variable is None:
                return holding.holds(part.type)
            entry = _Incomplete(variable, name, part.offset, part.path)
            paths[part.path.upper().replace(" ", "")] = entry
            return False

        for part in variables_of(owner, owner.name, 0):
            walk(part, visit)

    for program in session.analysis.programs.values():
        if program.source is None or program.source.scope is not Scope.LIBRARY:
            collect(program, program.qualified_name)
    for gvl, _ in found.gvls:
        collect(gvl, gvl.name)
    return paths


def _incomplete(decl: ast.VarDecl | None) -> VarSymbol | None:
    """The variable that a declaration leaves without a place in its area."""
    variable = decl.symbol if decl is not None else None
    if not isinstance(variable, VarSymbol) or variable.area is None or variable.home is Storage.DIRECT:
        return None
    return variable
