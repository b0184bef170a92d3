"""State of lowering a whole application: names, work list, data objects, constants, block types."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from dataclasses import dataclass, field

from tappet.core import ir
from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis.result import Analysis
from tappet.lang.parts import Holding, composed, types_holding
from tappet.lang.source import Scope
from tappet.lang.symbols import GvlSymbol, PouSymbol, Storage, VarSymbol

DATA_PREFIX = "tappet.data."
AREA_PREFIX = "tappet.area."
CONVERSION_LIBRARY = "Conversion"
"""Library in ST that turns values into text and back; part of every build."""
OBJECT_ALIGN = 64
"""Data objects begin on a cache line, so that tasks do not disturb each other."""


class LoweringError(Exception):
    """A construct that analysis accepts and code generation does not; names the place."""

    def __init__(self, message: str, uri: str = "", span: object = None) -> None:
        super().__init__(message)
        self.message = message
        self.uri = uri
        self.span = span


@dataclass(slots=True)
class Program:
    """Everything the bodies share while they are lowered."""

    analysis: Analysis
    module: ir.Module = field(default_factory=ir.Module)
    type_ids: dict[str, int] = field(default_factory=dict)
    """Numbers of function block types by qualified name; those of a running application are kept."""
    functions: dict[int, str] = field(default_factory=dict)
    """id(PouSymbol) to linkage name, for everything reached so far."""
    taken: set[str] = field(default_factory=set)
    bodies: dict[str, PouSymbol] = field(default_factory=dict)
    """Linkage name to what is lowered under it, without initialisers and task entries."""
    places: dict[str, dict[int, ir.Place]] = field(default_factory=dict)
    """Where the variables of each of these bodies are, by id(VarSymbol): locals, parameters, the result."""
    slots: dict[str, int] = field(default_factory=dict)
    """Places of virtual methods in the method tables, by upper-case name."""
    queue: list[Callable[[], None]] = field(default_factory=list)
    """Bodies still to be lowered."""
    homes: dict[int, str] = field(default_factory=dict)
    """id(VarSymbol) to data symbol, for members of lists and programs."""
    strings: dict[tuple[bytes, int], ir.Constant] = field(default_factory=dict)
    blocks: dict[str, t.FunctionBlock] = field(default_factory=dict)
    """Function block types that have instances, by unique name."""
    block_names: dict[int, str] = field(default_factory=dict)
    cycle_starts: list[str] = field(default_factory=list)
    """Functions without operands that every task calls before its programs."""
    dispatched: dict[str, None] = field(default_factory=dict)
    """Upper-case names of methods that are called virtually."""
    lower_pou: Callable[[PouSymbol], None] = lambda pou: None
    """Set by `lower`: lowers one body."""
    virtual: dict[tuple[int, str], tuple[ir.VirtualMethod, str, t.FunctionBlock | t.Interface]] = field(
        default_factory=dict
    )
    """Virtual methods by id() of the static type and upper-case name; what they reach is known at the end."""
    having: dict[str, list[PouSymbol]] = field(default_factory=dict)
    """Function blocks with a method, an accessor or a body that is called by this name."""
    area_use: dict[str, int] = field(default_factory=dict)
    """Bytes of the areas I, Q, M that declared variables and configured addresses reach to."""
    library: dict[str, PouSymbol] = field(default_factory=dict)
    """Functions of the conversion library by upper-case name."""
    queried: dict[str, t.FunctionBlock | t.Interface] = field(default_factory=dict)
    """Constants of `fitting`, filled at the end."""
    initialiser: object = None
    """`templates.Initialiser`, made on first use."""
    initial_functions: dict[int, str] = field(default_factory=dict)
    """id(FunctionBlock) to the function that runs the dynamic initial values of its members."""
    made_for: dict[str, tuple[t.FunctionBlock, Callable[[], None]]] = field(default_factory=dict)
    """Functions that are made from the members of a block and no text, by name: how to lower them again."""
    holding: dict[str, Holding[t.Type]] = field(default_factory=dict)
    """Whether types, by id(), hold an instance with a method of this name: see `life_cycle`."""
    check_names: dict[str, PouSymbol | None] = field(default_factory=dict)
    created: dict[str, t.Type] = field(default_factory=dict)
    """Blocks and structures that __NEW makes, by upper-case name: an online change cannot move them."""

    def __post_init__(self) -> None:
        self.claim()
        for pou in self.analysis.pous:
            for name in pou.vtable:
                self.having.setdefault(name, []).append(pou)

    def claim(self) -> None:
        """Which data object each variable of a list or program is in, and how far the areas are used."""
        self.homes.clear()
        self.area_use.clear()
        for gvl in self.analysis.gvls:
            symbol = data_symbol(gvl)
            for member in gvl.members.values():
                self.homes[id(member)] = symbol
                self.use_area(member)
        for pou in self.analysis.pous:
            if pou.kind == "PROGRAM":
                self._claim(pou)

    def _claim(self, pou: PouSymbol) -> None:
        symbol = data_symbol(pou)
        for variable in pou.locals.values():
            self.homes.setdefault(id(variable), symbol)
            self.use_area(variable)

    def use_area(self, variable: VarSymbol, function: ir.Function | None = None) -> None:
        """Note how far a variable at an address, or one that a function names, reaches into its area."""
        if variable.storage is Storage.DIRECT and variable.area is not None and variable.type is not None:
            end = variable.offset + max(variable.type.size, 1)
            use = self.area_use if function is None else function.areas
            use[variable.area] = max(use.get(variable.area, 0), end)

    def area_need(self) -> dict[str, int]:
        """Bytes of the areas I, Q, M that declarations and bodies reach to."""
        need = dict(self.area_use)
        for function in self.module.functions.values():
            for area, end in function.areas.items():
                need[area] = max(need.get(area, 0), end)
        return need

    def home(self, variable: VarSymbol) -> str:
        """Data symbol of a variable of a list or program."""
        found = self.homes.get(id(variable))
        return found if found is not None else DATA_PREFIX + (variable.owner or "").upper()

    # -- functions -----------------------------------------------------------------------------------

    def function(self, pou: PouSymbol) -> str:
        """Linkage name of a body; puts it on the work list when it is new."""
        name = self.functions.get(id(pou))
        if name is None:
            export = export_name(pou) if pou.kind == "FUNCTION" else None
            name = self.unique(export or qualified_name(pou))
            self.functions[id(pou)] = name
            self.queue.append(lambda: self.lower_pou(pou))
        return name

    def make_for(self, block: t.FunctionBlock, name: str, lower: Callable[[], None]) -> None:
        """Put a function that is made from the members of `block` on the work list."""
        self.made_for[name] = block, lower
        self.queue.append(lower)

    def unique(self, name: str) -> str:
        """`name`, or a variant of it that no function has."""
        candidate, number = name, 2
        while candidate in self.taken:
            candidate, number = f"{name}#{number}", number + 1
        self.taken.add(candidate)
        return candidate

    def library_function(self, name: str) -> PouSymbol | None:
        """A function of the conversion library that every application is built with."""
        if not self.library:
            for pou in self.analysis.pous:
                if pou.source is not None and pou.source.library == CONVERSION_LIBRARY:
                    self.library[pou.name.upper()] = pou
        return self.library.get(name)

    def check(self, name: str) -> PouSymbol | None:
        """The implicit check function `name` of the application, if it has one (LTYP-150)."""
        if name not in self.check_names:
            found = self.analysis.function(name)
            usable = found is not None and found.pou is not None and len(found.parameters) > 0
            self.check_names[name] = found if usable else None
        return self.check_names[name]

    # -- data ----------------------------------------------------------------------------------------

    def string_constant(self, data: bytes, align: int) -> ir.Constant:
        """Read-only bytes, shared by equal ones."""
        found = self.strings.get((data, align))
        if found is None:
            # named by content: the same code has the same text in every build
            name = hashlib.blake2b(data + align.to_bytes(4, "little"), digest_size=12).hexdigest()
            symbol = f"tappet.const.{name}"
            found = self.strings[(data, align)] = ir.Constant(symbol, data, align)
            self.module.constants[symbol] = found
        return found

    def keep_strings(self, used: set[str]) -> None:
        """Drop the constants whose symbols are not in `used`."""
        gone = [key for key, constant in self.strings.items() if constant.symbol not in used]
        for key in gone:
            del self.module.constants[self.strings.pop(key).symbol]

    # -- function blocks -----------------------------------------------------------------------------

    def block_name(self, block: t.FunctionBlock) -> str:
        """Unique upper-case name of a function block type."""
        name = self.block_names.get(id(block))
        if name is None:
            symbol = block.pou.symbol if block.pou is not None else None
            name = (qualified_name(symbol) if isinstance(symbol, PouSymbol) else block.name).upper()
            self.block_names[id(block)] = name
        return name

    def instantiate(self, block: t.FunctionBlock) -> int:
        """Note that there are instances of `block`; its type number."""
        name = self.block_name(block)
        if name not in self.type_ids:
            self.type_ids[name] = max(self.type_ids.values(), default=0) + 1
        self.blocks.setdefault(name, block)
        return self.type_ids[name]

    def fitting(self, wanted: t.FunctionBlock | t.Interface) -> str:
        """Constant with a byte per type number: 1 for function blocks that are, derive from or implement
        `wanted`."""
        name = self.block_name(wanted) if isinstance(wanted, t.FunctionBlock) else wanted.name.upper()
        symbol = f"tappet.fitting.{name}"
        while self.queried.get(symbol, wanted) is not wanted:
            symbol += "'"
        if symbol not in self.queried:
            self.module.constants[symbol] = ir.Constant(symbol, b"")
            self.queried[symbol] = wanted
        return symbol

    def expose(self, function: ir.Function, place: ir.Place, type_: t.Type | None) -> None:
        """Note that the address of a variable gets known in a function: pointers may change it."""
        if isinstance(place.base, ir.Data):
            function.exposed.add((place.base.symbol, place.root))
        elif isinstance(place.base, ir.Self):
            function.exposed.add((place.base.type, place.root))
        self._expose_blocks(function.exposed, type_)

    def holds(self, what: str, wanted: Callable[[t.Type], bool]) -> Holding[t.Type]:
        """Which types hold something; who wants the same asks under the same name. Kept between edits."""
        found = self.holding.get(what)
        if found is None:
            found = self.holding[what] = types_holding(wanted)
        return found

    def _expose_blocks(self, exposed: set[tuple[str, int]], type_: t.Type | None) -> None:
        if isinstance(type_, t.FunctionBlock):
            key = (self.block_name(type_), -1)
            if key in exposed:
                return
            exposed.add(key)
            derived = type_.base
            while derived is not None:
                exposed.add((self.block_name(derived), -1))
                derived = derived.base
        for inner in composed(type_):
            self._expose_blocks(exposed, inner)


def qualified_name(pou: PouSymbol) -> str:
    """`FB_Motor.Start`, `Standard.TON`."""
    name = pou.qualified_name or pou.name
    source = pou.source
    if source is not None and source.scope is Scope.LIBRARY and source.library:
        return f"{source.library}.{name}"
    return name


def path_of(owner: GvlSymbol | PouSymbol) -> str:
    """What paths of variables begin with: the name of a list or program, behind that of its library."""
    source = owner.source
    if source is None or source.scope is not Scope.LIBRARY or not source.library or "." in owner.name:
        return owner.name
    return f"{source.library}.{owner.name}"


def data_symbol(owner: GvlSymbol | PouSymbol) -> str:
    """External symbol of a list or program."""
    return DATA_PREFIX + path_of(owner).upper()


def export_name(pou: PouSymbol) -> str | None:
    """C symbol of a FUNCTION with attribute tappet_export."""
    return attribute_value(pou.pou.attributes, "tappet_export") if pou.pou is not None else None


def attribute_value(pragmas: list[ast.Pragma], name: str) -> str | None:
    """Value of an attribute pragma, None when it is missing."""
    for pragma in pragmas:
        if pragma.attribute is not None and pragma.attribute.lower() == name:
            return pragma.value or ""
    return None
