"""Which variables pointers may reach: those whose address is taken, and what contains or lies in these."""

from __future__ import annotations

from collections.abc import Iterable

from tappet.core import ir


class Exposure:
    """What the addresses taken so far expose; to be made again when there are more."""

    def __init__(self, module: ir.Module) -> None:
        self.module = module
        exposed = set().union(*(function.exposed for function in module.functions.values()))
        self.roots = set(exposed)
        """(data symbol or block type, root offset), offset -1 = all."""
        inside: dict[str, set[str]] = {}
        for (name, _), types in module.nested.items():
            inside.setdefault(name, set()).update(types)
        for name, root in exposed:
            found: Iterable[str] = module.nested.get((name, root), ()) if root >= 0 else inside.get(name, ())
            for type_ in found:
                self.roots |= {(relative, -1) for relative in self._family(type_)}
        self.names = {name for name, _ in self.roots}

    def reaches(self, names: Iterable[str], root: int) -> bool:
        """Whether a pointer may reach the variable at `root` of any of the data objects or block types."""
        for name in names:
            if (name, root) in self.roots or (name, -1) in self.roots:
                return True
            if any(
                not self.names.isdisjoint(self._family(t)) for t in self.module.nested.get((name, root), ())
            ):
                return True
        return False

    def concerns(self, names: Iterable[str], root: int) -> set[str]:
        """The data objects and block types whose exposure matters for that variable."""
        found = set(names)
        for name in list(found):
            for type_ in self.module.nested.get((name, root), ()):
                found |= self._family(type_)
        return found

    def _family(self, type_: str) -> frozenset[str]:
        return self.module.families.get(type_, frozenset({type_}))
