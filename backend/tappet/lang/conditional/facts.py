"""What conditions ask about: the types, POUs, variables and attributes that all texts declare."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from tappet.iec.words import ELEMENTARY_TYPES, STRING_TYPES, TYPE_SYNONYMS
from tappet.lang import ast
from tappet.lang.attributes import attribute

_ALIASES = {
    short: name for short, name in TYPE_SYNONYMS.items() if short != "BIT"
}  # which is a type of its own
_FAMILIES = {
    "ANY_BIT": ("bool", "bits"),
    "ANY_INT": ("signed", "unsigned"),
    "ANY_REAL": ("real",),
    "ANY_DATE": ("date",),
    "ANY_NUM": ("signed", "unsigned", "real"),
    "ANY_MAGNITUDE": ("signed", "unsigned", "real", "time"),
}
_GROUPS = {
    group: {name for name, row in ELEMENTARY_TYPES.items() if row.family in families}
    for group, families in _FAMILIES.items()
}
_GROUPS["ANY_STRING"] = set(STRING_TYPES)
_GROUPS["ANY_ELEMENTARY"] = set(ELEMENTARY_TYPES) | set(STRING_TYPES)
_DERIVED = "?DERIVED"  # structures, blocks, enumerations, arrays


@dataclass(slots=True)
class Facts:
    """Declared names in upper case."""

    types: dict[str, ast.TypeDecl | None] = field(default_factory=dict)
    """Data types, function blocks and interfaces."""
    pous: dict[str, set[str]] = field(default_factory=dict)
    """Attributes (lower case) by POU, `POU.ACTION` and `POU.METHOD`."""
    resources: set[str] = field(default_factory=set)
    """Global variable lists."""
    variables: dict[str, ast.VarDecl] = field(default_factory=dict)
    """Global variables by `NAME` and `LIST.NAME`; variables of POUs by `POU.NAME`."""
    tasks: frozenset[str] = frozenset()

    def variable(self, name: str, pou: str | None) -> ast.VarDecl | None:
        """The variable a text of `pou` sees under `name`."""
        key = name.upper()
        local = self.variables.get(f"{pou.upper()}.{key}") if pou else None
        return local or self.variables.get(key)

    def has_type(self, variable: ast.VarDecl, name: str) -> bool:
        """Whether the variable is of the elementary type or generic group `name` (LPRG-68)."""
        wanted = _ALIASES.get(name.upper(), name.upper())
        actual = self._elementary(variable.type_ref, 0)
        if wanted == "ANY":
            return True
        if wanted == "ANY_DERIVED":
            return actual == _DERIVED
        if wanted in _GROUPS:
            return actual in _GROUPS[wanted]
        if actual == wanted:
            return True
        return isinstance(variable.type_ref, ast.NamedType) and variable.type_ref.name.upper() == wanted

    def _elementary(self, ref: ast.TypeRef, depth: int) -> str:
        """Name of the elementary type at the end of aliases, subranges and references."""
        if isinstance(ref, ast.StringType):
            return "WSTRING" if ref.wide else "STRING"
        if isinstance(ref, ast.SubrangeType):
            return ref.base.upper()
        if isinstance(ref, ast.ReferenceType):
            return self._elementary(ref.base, depth)
        if isinstance(ref, ast.NamedType):
            name = ref.name.upper()
            if name not in self.types:
                return _ALIASES.get(name, name)
            declaration = self.types[name]
            if declaration is not None and depth < 20:  # an alias of itself is reported elsewhere
                return self._elementary(declaration.type_ref, depth + 1)
        return _DERIVED


def facts_of(units: Iterable[ast.Unit], tasks: Iterable[str] = ()) -> Facts:
    """The facts that the units declare together."""
    facts = Facts(tasks=frozenset(task.upper() for task in tasks))
    for unit in units:
        for declaration in unit.declarations:
            _add(facts, declaration, unit.source.owner)
    return facts


def _add(facts: Facts, declaration: ast.Declaration, owner: str | None) -> None:
    key = declaration.name.upper()
    if isinstance(declaration, ast.Pou):
        path = f"{owner.upper()}.{key}" if owner else key
        facts.pous[path] = {p.attribute.lower() for p in declaration.attributes if p.attribute}
        if declaration.kind == "FUNCTION_BLOCK":
            facts.types[key] = None
        for block in declaration.blocks:
            for variable in block.variables:
                facts.variables[f"{path}.{variable.name.upper()}"] = variable
        for child in (*declaration.methods, *declaration.actions):
            _add(facts, child, path)
    elif isinstance(declaration, ast.TypeDecl):
        facts.types[key] = declaration
    elif isinstance(declaration, ast.Interface):
        facts.types[key] = None
    elif isinstance(declaration, ast.GlobalList):
        facts.resources.add(key)
        qualified = attribute(declaration.attributes, "qualified_only") is not None
        for block in declaration.blocks:
            for variable in block.variables:
                name = variable.name.upper()
                facts.variables[f"{key}.{name}"] = variable
                if not qualified:
                    facts.variables.setdefault(name, variable)
