"""Which texts an edit of declarations concerns: those that are declared again, and those that need no more
than the size of what these declare (`relayout`)."""

from __future__ import annotations

from collections.abc import Mapping

from tappet.lang import ast
from tappet.lang.analysis.context import Session
from tappet.lang.analysis.edits.identifiers import Identifiers, identifiers_of
from tappet.lang.source import Scope
from tappet.lang.symbols import PouSymbol

Object = tuple[Scope, str]
"""Scope and upper-case name."""


class Dependents:
    """The texts that an edit concerns.

    `again`: uris of those that are declared again, always whole objects with their methods, and all that has
    messages, as a suggestion may change. `sized`: uris of those that need no more than sizes.
    """

    def __init__(
        self,
        session: Session,
        identifiers: Mapping[str, Identifiers],
        edited: Mapping[str, tuple[ast.Unit, ast.Unit]],
    ) -> None:
        """`identifiers`: of all texts of the project; `edited`: old and new tree by uri."""
        self._session = session
        self._identifiers = identifiers
        self._edited = edited
        self._before = {uri: identifiers_of(old) for uri, (old, _) in edited.items()}
        self._texts = _texts_of_objects(identifiers)
        self._others = {uri: w.declared for uri, w in identifiers.items() if not only_configures(w.unit)}
        self._wholly: set[str] = set()
        """Names of which others can depend on anything."""
        self._by_size: set[str] = set()
        """Names of blocks and structures of which plain variables need the size only."""
        self.again: set[str] = set()
        self.sized: set[str] = set()
        for before in self._before.values():
            self._wholly |= before.global_names - self._laid_out(before.unit)
        self._find()

    def _find(self) -> None:
        declared = self._session.declared
        todo = set(self._edited)
        todo.update(uri for uri, record in declared.items() if record.messages and uri in self._others)
        while todo:
            uri = todo.pop()
            self.again.add(uri)
            self._others.pop(uri, None)
            unit = self._identifiers[uri].unit
            laid_out = self._laid_out(unit)
            self._by_size |= laid_out
            self._wholly |= self._identifiers[uri].global_names - laid_out
            for key in objects_of(unit):
                todo.update(text for text in self._texts[key] if text not in self.again)
            if not todo:
                wholly = self._wholly
                todo = {uri for uri, names in self._others.items() if not wholly.isdisjoint(names)}
            if not todo:
                todo = self._find_sized()

    def _find_sized(self) -> set[str]:
        """Enters the texts that need sizes only; gives those that need more."""
        names, fresh = set(self._by_size), set(self._by_size)
        self.sized = set()
        left = dict(self._others)
        while fresh:
            holding = {uri for uri, identifiers in left.items() if not fresh.isdisjoint(identifiers)}
            fresh = set()
            for uri in holding:
                identifiers = self._identifiers[uri]
                if not names.intersection(identifiers.declared) <= identifiers.plain_types:
                    return {uri}
                self.sized.add(uri)
                del left[uri]
                fresh.update(name for _, name in objects_of(identifiers.unit))
            fresh -= names
            names |= fresh
        return set()

    def _laid_out(self, unit: ast.Unit) -> frozenset[str]:
        """Names of the objects of a text of which a variable without initial value needs the size only."""
        found = set()
        edit = self._edited.get(unit.source.uri)
        before, after = edit if edit is not None else (unit, unit)
        for old, new in zip(before.declarations, after.declarations, strict=True):
            attributes = [[pragma.text for pragma in d.attributes] for d in (old, new)]
            if (
                attributes[0] == attributes[1]
                and _is_laid_out(old)
                and _is_laid_out(new)
                and not self._starts(old)
            ):
                found.add(new.name.upper())
        return frozenset(found)

    def _starts(self, declaration: ast.Declaration) -> bool:
        """Whether a block may have FB_Init, which each variable of it has to obey."""
        symbol = declaration.symbol if isinstance(declaration, ast.Pou) else None
        scopes = [scope for scope in Scope if (scope, declaration.name.upper()) in self._texts]
        keys = [(scope, declaration.name.upper()) for scope in scopes]
        base = symbol.base if isinstance(symbol, PouSymbol) else None
        while base is not None:
            if base.source is not None:
                keys.append((base.source.scope, base.name.upper()))
            if "FB_INIT" in base.methods:
                return True
            base = base.base
        texts = [text for key in keys for text in self._texts.get(key, ())]
        tables = (self._identifiers, self._before)
        return any("FB_INIT" in table[uri].all for uri in texts for table in tables if uri in table)


def _is_laid_out(declaration: ast.Declaration) -> bool:
    if isinstance(declaration, ast.Pou):
        return declaration.kind in ("FUNCTION_BLOCK", "PROGRAM")
    if isinstance(declaration, ast.TypeDecl):
        return isinstance(declaration.type_ref, ast.StructType) and declaration.initial is None
    return isinstance(declaration, ast.Interface)


def _texts_of_objects(identifiers: Mapping[str, Identifiers]) -> dict[Object, list[str]]:
    found: dict[Object, list[str]] = {}
    for uri, one in identifiers.items():
        for key in objects_of(one.unit):
            found.setdefault(key, []).append(uri)
    return found


def objects_of(unit: ast.Unit) -> set[Object]:
    """The objects that a text belongs to."""
    scope, owner = unit.source.scope, unit.source.owner
    if owner is not None:
        return {(scope, owner.upper())}
    return {(scope, declaration.name.upper()) for declaration in unit.declarations}


def configures(declaration: ast.Declaration) -> bool:
    """Whether a list holds VAR_CONFIG, which concerns the whole program."""
    return isinstance(declaration, ast.GlobalList) and any(
        block.section == "VAR_CONFIG" for block in declaration.blocks
    )


def only_configures(unit: ast.Unit) -> bool:
    """Whether a text is nothing but VAR_CONFIG."""
    return bool(unit.declarations) and all(map(configures, unit.declarations))
