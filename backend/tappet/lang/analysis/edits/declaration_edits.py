"""A second analysis after an edit of declarations.

The edited texts, and those whose declarations can depend on them, are declared again (`dependents`); those
that need no more than a size are laid out again (`relayout`). Objects keep their symbols, so that all others
stay valid; of the bodies, those are analysed that the edit invalidates (`invalidated_bodies`).

An edit qualifies when the same objects are declared as before, with the same bases and interfaces; it may
add, change and take away variables, values, methods and parameters. Everything else takes the full way.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from tappet.lang import ast
from tappet.lang.analysis.bodies import State, finish
from tappet.lang.analysis.collect import collect
from tappet.lang.analysis.collected import Collected
from tappet.lang.analysis.context import SUGGESTION_LIMIT, Key, Record
from tappet.lang.analysis.declare import all_pous, declare
from tappet.lang.analysis.edits.dependents import Dependents, configures
from tappet.lang.analysis.edits.identifiers import Identifiers, identifiers_of
from tappet.lang.analysis.edits.invalidated_bodies import Invalidation, contents, sizes
from tappet.lang.analysis.edits.relayout import Layout
from tappet.lang.analysis.result import Analysis, AnalysisOptions, Redeclared
from tappet.lang.analysis.scope import Level
from tappet.lang.diagnostics import Diagnostic
from tappet.lang.languages.support import implicit_names, looks_names_up
from tappet.lang.source import Scope
from tappet.lang.symbols import PouSymbol, Symbol

AT_ONCE = 100_000
"""Bodies in texts of so many characters together do not wait: to put all messages together twice takes
longer."""
_OF_CIRCLES = ("E0408", "E0107")


def redeclare(
    previous: Analysis,
    units: Sequence[ast.Unit],
    options: AnalysisOptions,
    first: frozenset[str] | None = None,
) -> Analysis | None:
    """The analysis of `units` made from `previous`; None when the edit does not qualify. Bodies of other
    texts than `first` may wait, see `analyse`."""
    state = previous.state
    if not isinstance(state, State) or options != previous.options:
        return None
    if state.session.values_of_project:  # what libraries declare depends on the project
        return None
    if len(units) != len(state.units) or len({unit.source.uri for unit in units}) != len(units):
        return None
    pairs = [(old, new) for old, new in zip(state.units, units, strict=True) if old is not new]
    if not pairs or not all(_same_objects(old, new) for old, new in pairs):
        return None
    again = _Redeclaration(state, units, {new.source.uri: (old, new) for old, new in pairs})
    if not again.qualifies():
        return None
    previous.state = None
    return again.run(options, first)


# -- which edits qualify ----------------------------------------------------------------------------


def _same_objects(old: ast.Unit, new: ast.Unit) -> bool:
    """Whether two texts declare the same objects, whatever is inside."""
    if replace(old.source, text="", body_line=0, bodies=()) != replace(
        new.source, text="", body_line=0, bodies=()
    ):
        return False
    if new.source.scope is Scope.LIBRARY or looks_names_up(old) or looks_names_up(new):
        return False
    if len(old.declarations) != len(new.declarations):
        return False
    owned = old.source.owner is not None
    return all(map(_same_head, old.declarations, new.declarations, [owned] * len(old.declarations)))


def _same_head(old: ast.Declaration, new: ast.Declaration, owned: bool) -> bool:
    if old.__class__ is not new.__class__ or (old.name != new.name and not owned):
        return False
    if isinstance(old, ast.Pou) and isinstance(new, ast.Pou):
        heads = [(p.kind, p.extends, p.implements) for p in (old, new)]
        return heads[0] == heads[1] and (owned or old.modifiers == new.modifiers)
    if isinstance(old, ast.Interface) and isinstance(new, ast.Interface):
        return old.extends == new.extends
    if isinstance(old, ast.TypeDecl) and isinstance(new, ast.TypeDecl):
        return old.extends == new.extends and old.type_ref.__class__ is new.type_ref.__class__
    return not configures(old) and not configures(new)


def read_identifiers(state: State) -> None:
    """Reads the identifiers of all texts, which every edit of declarations asks for."""
    state.identifiers = _identifiers(state, state.units)


def _identifiers(state: State, units: Iterable[ast.Unit]) -> dict[str, Identifiers]:
    """Of all texts but those of libraries, which see nothing of the project."""
    found: dict[str, Identifiers] = {}
    for unit in units:
        if unit.source.scope is not Scope.LIBRARY:
            known = state.identifiers.get(unit.source.uri)
            found[unit.source.uri] = known if known and known.unit is unit else identifiers_of(unit)
    return found


class _Redeclaration:
    """One analysis after an edit."""

    def __init__(
        self, state: State, units: Sequence[ast.Unit], edited: dict[str, tuple[ast.Unit, ast.Unit]]
    ) -> None:
        self.state = state
        self.session = session = state.session
        self.units = units
        self.edited = edited
        """Texts that are new: old and new tree by uri."""
        self.identifiers = _identifiers(state, units)
        self._numbers = {unit.source.uri: (number, unit) for number, unit in enumerate(units)}
        found = Dependents(session, self.identifiers, edited)
        self.texts = found.again
        """Uris of the texts that are declared again."""
        self.layout = Layout(session, state.found, state.declarations, frozenset(found.sized))
        """Of the texts that are only laid out again."""

    def qualifies(self) -> bool:
        """Whether every object that is declared again is the only one of its name."""
        levels = self.session.levels
        known = [levels.application, levels.pous, *levels.libraries.values()]
        for unit in self._units_again():
            level = levels.of(unit.source)
            own_parts = [isinstance(d, ast.Property) or _is_owned(d) for d in unit.declarations]
            if any(own_parts) and not all(own_parts):
                return False
            for declaration in unit.declarations:
                if configures(declaration):
                    return False
                if _is_owned(declaration) or isinstance(declaration, ast.Property):
                    continue
                key = declaration.name.upper()
                holders = [other for other in known if key in other.objects]
                symbol = level.objects.get(key)
                if holders != [level] or symbol is None or symbol.source is None:
                    return False
                if symbol.source.uri != unit.source.uri:
                    return False
        return True

    def _units_again(self) -> list[ast.Unit]:
        return [unit for unit in self.units if unit.source.uri in self.texts]

    # -- declaring again

    def run(self, options: AnalysisOptions, first: frozenset[str] | None) -> Analysis | None:
        """Declares the texts again and analyses the bodies that this concerns; None when it turns out not to
        qualify: the state is used up then."""
        state, session = self.state, self.session
        session.analysis = Analysis(options, continued=True)
        session.diagnostics, session.accounted = [], None
        if not state.waiting:
            session.suggestions = 0
        earlier = {uri: session.made.pop(uri) for uri in self.texts if uri in session.made}
        before, sizes_before = contents(earlier), sizes(earlier) | sizes(self.layout.made)
        entities = _ids(earlier)
        session.before = {uri: dict(table) for uri, table in earlier.items()}
        old_pous = _pous(earlier.values())
        for uri in self.texts:
            session.declared.pop(uri, None)
        for pou in old_pous:
            state.declarations.bodies.pop(id(pou), None)
        part = self._collect()
        if part is None:
            return None
        self._merge(part)
        moved = self._renew_tables()
        self.layout.forget()
        declare(session, part, state.declarations, state.found)
        kept = len(session.diagnostics)
        self.layout.complete()
        if len(session.diagnostics) != kept or not all(map(self._stays_where_it_is, session.diagnostics)):
            return None
        made = {uri: session.made[uri] for uri in self.texts if uri in session.made}
        self._forget(old_pous, _pous(made.values()))
        invalidation = Invalidation(before, session.before, made, part, frozenset(self.edited), self.layout)
        invalidation.note(moved)
        invalidation.note_sizes(sizes_before, sizes(made) | sizes(self.layout.made))
        session.before = {}
        looked_up = implicit_names(self.units)
        if looked_up and any(name.startswith(looked_up) for name in invalidation.all_names()):
            return None
        texts = self.texts | self.layout.made.keys()
        for unit in self.units:
            if unit.source.uri in texts:
                state.texts.pop(id(unit), None)
        state.variable_checks.forget(pou for pou in all_pous(state.found) if _uri(pou) in texts)
        state.units = tuple(self.units)
        state.identifiers = self.identifiers
        bodies = self._analyse_bodies(invalidation, first)
        entities |= _ids(made) | _ids(self.layout.made)
        session.analysis.redeclared = Redeclared(frozenset(texts), frozenset(entities), bodies)
        return finish(state) if session.suggestions < SUGGESTION_LIMIT else None

    def _stays_where_it_is(self, message: Diagnostic) -> bool:
        """Whether a full analysis would report the same there: which type of a circle it reports depends on
        the one that is laid out first."""
        return message.uri in self.texts and (message.code not in _OF_CIRCLES or not self.layout.made)

    def _analyse_bodies(self, invalidation: Invalidation, first: frozenset[str] | None) -> list[PouSymbol]:
        """Those of which something else may have become known."""
        state = self.state
        names = self._names_declared() if self.session.options.static.codes else frozenset()
        for pou in all_pous(state.found):
            record = state.records.get(id(pou))
            assert pou.source is not None
            identifiers = self.identifiers.get(pou.source.uri)
            if record is None or (
                identifiers is not None and invalidation.invalidates(pou, record, identifiers)
            ):
                state.waiting[id(pou)] = pou
            elif identifiers is not None and self._may_read_otherwise(record, identifiers, names):
                state.coding_waiting[id(pou)] = pou
        found = list(state.waiting.values())
        if first is None or _length_of_texts((*found, *state.coding_waiting.values())) <= AT_ONCE:
            state.analyse_waiting()
        else:
            state.analyse_waiting(first=first | self.edited.keys())
        return found

    def _names_declared(self) -> frozenset[str]:
        """Names of which coding rules may see something else now."""
        texts = self.texts | self.layout.made.keys()
        return frozenset().union(*(self.identifiers[uri].global_names for uri in texts))

    def _may_read_otherwise(self, record: Record, identifiers: Identifiers, names: frozenset[str]) -> bool:
        """Whether coding rules may report something else about a body that means the same."""
        if not names:
            return False
        uri = identifiers.unit.source.uri
        if uri in self.texts or uri in self.layout.made or not names.isdisjoint(identifiers.all):
            return True
        return any(r.uri in self.edited for message in record.coding for r in message.related)

    def _collect(self) -> Collected | None:
        """The symbols of the texts, in the places of those before; None when an object is another one now."""
        session = self.session
        own: list[Level] = [session.levels.application, session.levels.pous]
        kept = [(dict(level.objects), list(level.gvls), level.enum_values) for level in own]
        for level in own:
            for key in [k for k, s in level.objects.items() if _uri(s) in self.texts]:
                del level.objects[key]
            level.enum_values = [e for e in level.enum_values if _uri(e[2]) not in self.texts]
        part = collect(session, self._units_again())
        for level, (objects, lists, _) in zip(own, kept, strict=True):
            if any(objects.get(key) is not symbol for key, symbol in level.objects.items()):
                return None
            if len(objects) != len(level.objects):
                return None
            level.objects, level.gvls = objects, lists
            level.enum_values.sort(key=lambda entry: self._order(entry[2]))
        return part

    def _order(self, value: Symbol) -> tuple[bool, int]:
        """Where an enumeration value would be collected: what has an owner comes last."""
        number, unit = self._numbers[_uri(value)]
        return any(_is_owned(d) or isinstance(d, ast.Property) for d in unit.declarations), number

    def _merge(self, part: Collected) -> None:
        """Puts what the texts declare now into what is known of the whole."""
        found, texts = self.state.found, self.texts
        types = {id(entry[0]): entry for entry in part.types}
        found.types = [types.get(id(entry[0]), entry) for entry in found.types]
        lists = {id(entry[0]): entry for entry in part.gvls}
        found.gvls = [lists.get(id(entry[0]), entry) for entry in found.gvls]
        interfaces = {id(entry[0]): entry for entry in part.interfaces}
        found.interfaces = [interfaces.get(id(entry[0]), entry) for entry in found.interfaces]
        found.own |= part.own
        kept = {k: v for k, v in found.enum_values.items() if v and _uri(v[0]) not in texts}
        found.enum_values = kept | part.enum_values
        values = {id(value) for entries in kept.values() for value in entries}
        found.enum_of_value = {k: v for k, v in found.enum_of_value.items() if k in values}
        found.enum_of_value |= part.enum_of_value
        found.local_enums = [e for e in found.local_enums if e[1].uri not in texts] + part.local_enums

    def _renew_tables(self) -> set[str]:
        """Makes the tables of global names again; the names that denote something else now."""
        levels = self.session.levels
        return levels.renew() if any(self._gives_names(unit) for unit in self._units_again()) else set()

    def _gives_names(self, unit: ast.Unit) -> bool:
        """Whether a text makes more known by plain name than its objects, now or before."""
        old = self.edited.get(unit.source.uri)
        names = identifiers_of(old[0]).global_names if old is not None else frozenset()
        return len(names | self.identifiers[unit.source.uri].global_names) > len(unit.declarations)

    def _forget(self, old: Iterable[PouSymbol], new: Iterable[PouSymbol]) -> None:
        """Drops what is kept of methods and accessors that are gone."""
        state = self.state
        living = {id(pou) for pou in new}
        for pou in old:
            if id(pou) not in living:
                state.records.pop(id(pou), None)
                state.waiting.pop(id(pou), None)
                state.coding_waiting.pop(id(pou), None)
                state.session.calls.pop(id(pou), None)
                state.found.own.pop(id(pou), None)


def _ids(made: Mapping[str, Mapping[Key, object]]) -> set[int]:
    """id() of all symbols and types of the declarations of some texts."""
    return {id(entity) for table in made.values() for entity in table.values()}


def _pous(tables: Iterable[dict[Key, object]]) -> list[PouSymbol]:
    return [entity for table in tables for entity in table.values() if isinstance(entity, PouSymbol)]


def _length_of_texts(pous: Iterable[PouSymbol]) -> int:
    """Characters of the texts that some bodies are in."""
    texts = {pou.source.uri: pou.source.text for pou in pous if pou.source is not None}
    return sum(map(len, texts.values()))


def _uri(symbol: Symbol) -> str:
    return symbol.source.uri if symbol.source is not None else ""


def _is_owned(declaration: ast.Declaration) -> bool:
    return isinstance(declaration, ast.Pou) and declaration.kind in ("METHOD", "ACTION", "TRANSITION")
