"""Which names a text sees: those of the application, the POUs view, the libraries (CON-06..CON-09)."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

from tappet.lang.nearest import nearest
from tappet.lang.source import Scope, Source, Use
from tappet.lang.symbols import (
    EnumValueSymbol,
    GvlSymbol,
    InterfaceSymbol,
    NamespaceSymbol,
    PouSymbol,
    Symbol,
    TypeSymbol,
    VarSymbol,
)


@dataclass(eq=False, slots=True)
class AmbiguousSymbol(Symbol):
    """A name that several lists, enumerations or libraries declare; it must be qualified."""

    choices: list[str] = field(default_factory=list)


@dataclass(eq=False, slots=True)
class QualifiedSymbol(Symbol):
    """A name that exists but only behind another one."""

    choice: str = ""
    """The whole name."""
    target: Symbol | None = None
    """What the whole name denotes."""
    library: str = ""
    """The library whose names need the namespace; '' where the attribute 'qualified_only' is the cause."""


@dataclass(slots=True)
class Level:
    """Objects of one place: the application, the POUs view, or one library."""

    label: str
    """'' for application and POUs view, the namespace of a library."""
    library: str = ""
    """Name of the library; its own texts and others may qualify by it, too, when the namespace is another."""
    qualified_only: bool = False
    """A library whose names the application uses behind the namespace only."""
    uses: tuple[Use, ...] = ()
    """Libraries that this one needs."""
    private: bool = False
    """Seen by the libraries that use it only."""
    objects: dict[str, Symbol] = field(default_factory=dict)
    gvls: list[GvlSymbol] = field(default_factory=list)
    enum_values: list[tuple[str, bool, EnumValueSymbol]] = field(default_factory=list)
    """(type name, qualified_only, value)"""
    values: dict[str, Symbol] = field(default_factory=dict)
    """Global variables and enumeration values named as a type, which hides them in `names`."""

    def names(self) -> dict[str, Symbol]:
        """Everything visible by its plain name: objects hide global variables and enumeration values."""
        found: dict[str, Symbol] = {}
        origin: dict[str, str] = {}
        for gvl in self.gvls:
            for key, member in gvl.members.items():
                self._add(found, origin, key, member, gvl.name, gvl.qualified_only)
        for type_name, qualified, value in self.enum_values:
            self._add(found, origin, value.name.upper(), value, type_name, qualified)
        for key, symbol in self.objects.items():
            hidden = found.get(key)
            if isinstance(hidden, (VarSymbol, EnumValueSymbol)) and is_type(symbol):
                self.values[key] = hidden
        found.update(self.objects)
        return found

    def seen_names(self, qualified_only: bool) -> dict[str, Symbol]:
        """The names of a library for texts outside of it; `qualified_only`: each as one to be qualified."""
        names = {key: symbol for key, symbol in self.names().items() if not self._is_inside(symbol)}
        if not qualified_only:
            return names
        return {key: self._behind(symbol) for key, symbol in names.items() if symbol.access != "INTERNAL"}

    def _is_inside(self, symbol: Symbol) -> bool:
        """A name that could be qualified by an INTERNAL type or list only."""
        if not isinstance(symbol, QualifiedSymbol):
            return False
        outer = self.objects.get(symbol.choice.partition(".")[0].upper())
        return outer is not None and outer.access == "INTERNAL"

    def _behind(self, symbol: Symbol) -> QualifiedSymbol:
        target: Symbol | None = symbol
        inner = symbol.name
        if isinstance(symbol, QualifiedSymbol):
            inner, target = symbol.choice, symbol.target
        elif isinstance(symbol, AmbiguousSymbol):
            inner, target = symbol.choices[0], None
        return QualifiedSymbol(
            symbol.name, choice=f"{self.label}.{inner}", target=target, library=self.library
        )

    @staticmethod
    def _add(
        found: dict[str, Symbol],
        origin: dict[str, str],
        key: str,
        symbol: Symbol,
        where: str,
        qualified: bool,
    ) -> None:
        old = found.get(key)
        if qualified:
            if old is None:
                found[key] = QualifiedSymbol(symbol.name, choice=f"{where}.{symbol.name}", target=symbol)
        elif old is None or isinstance(old, QualifiedSymbol):
            found[key] = symbol
            origin[key] = where
        elif isinstance(old, AmbiguousSymbol):
            old.choices.append(f"{where}.{symbol.name}")
        else:
            choices = [f"{origin[key]}.{symbol.name}", f"{where}.{symbol.name}"]
            found[key] = AmbiguousSymbol(symbol.name, choices=choices)


@dataclass(slots=True)
class Levels:
    """All levels of one analysis and the look-up tables made of them."""

    application: Level = field(default_factory=lambda: Level(""))
    pous: Level = field(default_factory=lambda: Level(""))
    libraries: dict[str, Level] = field(default_factory=dict)
    system: dict[str, Symbol] = field(default_factory=dict)
    """Names every text sees last, such as `__SYSTEM`; the one that a single library declares goes first."""
    _tables: dict[str, dict[str, Symbol]] = field(default_factory=dict)
    _values: dict[str, dict[str, Symbol]] = field(default_factory=dict)
    _namespaces: dict[str, NamespaceSymbol] = field(default_factory=dict)

    def around(self, shared: bool) -> Levels:
        """New levels of an application around the libraries of these; `shared`: with their look-up tables, as
        no library is added."""
        levels = Levels(libraries=dict(self.libraries), system=dict(self.system))
        if shared:
            self._library_names()
            levels._tables, levels._values = dict(self._tables), dict(self._values)
            levels._namespaces = self._namespaces
        return levels

    def of(self, source: Source) -> Level:
        """The level the objects of a source belong to."""
        if source.scope is Scope.APPLICATION:
            return self.application
        if source.scope is Scope.POUS:
            return self.pous
        label = source.namespace or source.library or "Library"
        found = self.libraries.get(label.upper())
        if found is None:
            found = Level(label, source.library or label, source.qualified_only, source.uses, source.private)
            self.libraries[label.upper()] = found
        return found

    def seen_by(self, source: Source) -> dict[str, Symbol]:
        """What a text of this source sees by plain name, own locals excepted. Valid once all is collected."""
        key = self._key(source)
        table = self._tables.get(key)
        if table is None:
            table = dict(self._library_names())
            values = self._values.setdefault(key, {})
            if source.scope is Scope.LIBRARY:
                own = self.of(source)
                table.update(self._used_names(own))
                table.update(own.names())
                values.update(own.values)
            else:
                table.update(self.pous.names())
                values.update(self.pous.values)
                if source.scope is Scope.APPLICATION:
                    table.update(_without_qualified(self.application.names(), table))
                    values.update(self.application.values)
            for name in [n for n in values if not is_type(table[n])]:
                del values[name]
            self._tables[key] = table
        return table

    def seen_at_reference(self, source: Source) -> dict[str, Symbol]:
        """What a value sees that the application gives to a parameter of this library: its own names, then
        what the library sees."""
        key = f"R {self._key(source)}"
        table = self._tables.get(key)
        if table is None:
            table = dict(self.seen_by(source))
            for level in (self.pous, self.application):
                table.update(_without_qualified(level.names(), table))
            self._tables[key] = table
        return table

    def renew(self) -> set[str]:
        """Fills the tables of application and POUs view again after lists and enumerations have changed; the
        names that denote something else now."""
        changed: set[str] = set()
        for level in (self.pous, self.application):
            level.values = {}
        for scope in (Scope.POUS, Scope.APPLICATION):
            key = scope.value
            if key not in self._tables:
                continue
            shared = self._tables.pop(key), self._values.pop(key)  # every view of a text holds them
            self.seen_by(Source("", "", scope))
            fresh = self._tables[key], self._values[key]
            self._tables[key], self._values[key] = shared
            for table, new in zip(shared, fresh, strict=True):
                names = table.keys() | new.keys()
                changed.update(name for name in names if not _same(table.get(name), new.get(name)))
                table.clear()
                table.update(new)
        return changed

    def values_seen_by(self, source: Source) -> dict[str, Symbol]:
        """Variables and enumeration values with the name of a type: where a value stands, they are meant."""
        self.seen_by(source)
        return self._values[self._key(source)]

    def _key(self, source: Source) -> str:
        if source.scope is Scope.LIBRARY:
            return f"L {(source.namespace or source.library or 'Library').upper()}"
        return source.scope.value

    def _used_names(self, level: Level) -> dict[str, Symbol]:
        """What a library sees of those it needs: these versions, also where the application has others."""
        table: dict[str, Symbol] = {}
        for name, label, qualified_only in level.uses:
            used = self.libraries.get(label.upper())
            if used is not None:
                table.update(_without_qualified(used.seen_names(qualified_only), table))
                namespace = self._namespace(used)
                table[name.upper()] = namespace
                table.setdefault(used.library.upper(), namespace)
        return table

    def _namespace(self, level: Level) -> NamespaceSymbol:
        """A library behind its name: its objects, and the libraries it needs by the names it gives to them
        (LDEC-15)."""
        found = self._namespaces.get(level.label.upper())
        if found is None:
            found = NamespaceSymbol(level.label, members=dict(level.names()))
            self._namespaces[level.label.upper()] = found
            for name, label, _ in level.uses:
                used = self.libraries.get(label.upper())
                if used is not None:
                    found.members.setdefault(name.upper(), self._namespace(used))
        return found

    def _library_names(self) -> dict[str, Symbol]:
        table = self._tables.get("libraries")
        if table is None:
            table = {}
            public = [level for level in self.libraries.values() if not level.private]
            for level in public:
                table.setdefault(level.label.upper(), self._namespace(level))
            for level in public:
                table.setdefault(level.library.upper(), self._namespace(level))
            for level in public:
                for key, symbol in level.seen_names(level.qualified_only).items():
                    old = table.get(key)
                    if old is None or (symbol.access != "INTERNAL" and _gives_way(old)):
                        table[key] = symbol
                    elif isinstance(symbol, QualifiedSymbol) or symbol.access == "INTERNAL":
                        continue
                    else:
                        choice = f"{level.label}.{symbol.name}"
                        choices = old.choices if isinstance(old, AmbiguousSymbol) else [_qualified(old)]
                        table[key] = AmbiguousSymbol(symbol.name, choices=[*choices, choice])
            for key, symbol in self.system.items():
                old = table.get(key)
                if old is None or isinstance(old, AmbiguousSymbol) or _gives_way(old):
                    table[key] = symbol
            self._tables["libraries"] = table
        return table


def _same(old: Symbol | None, new: Symbol | None) -> bool:
    """Whether a name denotes the same."""
    if isinstance(old, AmbiguousSymbol) and isinstance(new, AmbiguousSymbol):
        return (old.name, old.choices) == (new.name, new.choices)
    if isinstance(old, QualifiedSymbol) and isinstance(new, QualifiedSymbol):
        return (old.name, old.choice) == (new.name, new.choice)
    return old is new


def is_type(symbol: Symbol) -> bool:
    """Whether a name denotes a data type, a function block or an interface: no value."""
    if isinstance(symbol, PouSymbol):
        return symbol.kind == "FUNCTION_BLOCK"
    return isinstance(symbol, (TypeSymbol, InterfaceSymbol))


def _without_qualified(names: dict[str, Symbol], outer: dict[str, Symbol]) -> dict[str, Symbol]:
    """A name that needs qualification does not hide one of an outer level that needs none."""
    return {k: s for k, s in names.items() if not (isinstance(s, QualifiedSymbol) and k in outer)}


def _gives_way(symbol: Symbol) -> bool:
    """Whether a name of a library is hidden by a plain one of another."""
    return isinstance(symbol, (NamespaceSymbol, QualifiedSymbol)) or symbol.access == "INTERNAL"


def _qualified(symbol: Symbol) -> str:
    source = symbol.source
    prefix = (source.namespace or source.library) if source else None
    return f"{prefix}.{symbol.name}" if prefix else symbol.name


Fits = Callable[[Symbol], bool]
_PROPOSED = 8
"""Near names among which one of the right kind is looked for."""


def place_of(symbol: Symbol) -> str:
    """Where a symbol is declared, for a suggestion: `GVL_Drive`, a library, or what kind of object it is."""
    if isinstance(symbol, VarSymbol):
        return symbol.owner or symbol.section
    if isinstance(symbol, EnumValueSymbol):
        return str(symbol.type)
    if isinstance(symbol, PouSymbol):
        return symbol.kind.lower().replace("_", " ")
    return describe(symbol)


def describe(symbol: Symbol) -> str:
    """What a symbol is, in words."""
    if isinstance(symbol, VarSymbol):
        return "constant" if "CONSTANT" in symbol.flags else "variable"
    if isinstance(symbol, PouSymbol):
        return symbol.kind.lower().replace("_", " ")
    if isinstance(symbol, TypeSymbol):
        return "data type"
    if isinstance(symbol, GvlSymbol):
        return "global variable list"
    if isinstance(symbol, EnumValueSymbol):
        return "enumeration value"
    if isinstance(symbol, NamespaceSymbol):
        return "namespace"
    return type(symbol).__name__.removesuffix("Symbol").lower()


def suggestion(name: str, *tables: Iterable[tuple[str, Symbol]], fits: Fits | None = None) -> str:
    """`Did you mean 'Speed' (GVL_Drive)?` for the nearest known name, '' when none is near; what `fits` tells
    to be of the right kind goes first."""
    known: dict[str, Symbol] = {}
    for table in tables:
        for key, symbol in table:
            known.setdefault(key, symbol)
    near = nearest(name, known, _PROPOSED)
    if not near:
        return ""
    if fits is not None:
        near.sort(key=lambda key: not fits(known[key]))  # stable: the nearest of its kind stays first
    symbol = known[near[0]]
    if isinstance(symbol, QualifiedSymbol):
        return f"Did you mean '{symbol.choice}'?"
    if isinstance(symbol, AmbiguousSymbol):
        return f"Did you mean '{symbol.choices[0]}'?"
    return f"Did you mean '{symbol.name}' ({place_of(symbol)})?"
