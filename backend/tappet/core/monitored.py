"""What accessors of properties with `{attribute 'monitoring' := 'variable'}` do at their end (LPRG-32)."""

from __future__ import annotations

from collections.abc import Callable

from tappet.core import assign, ir
from tappet.core.body import Body
from tappet.core.scalars import scalar_of
from tappet.lang import ast
from tappet.lang.analysis.monitored import monitoring_name
from tappet.lang.symbols import PouSymbol, VarSymbol


def keeper(b: Body, pou: PouSymbol) -> Callable[[], None] | None:
    """What emits the store of the value that was got or set; None when the property is not monitored."""
    owner, name = pou.owner, pou.name[len("__get") :]
    if owner is None or not pou.name.startswith(("__get", "__set")):
        return None
    kept = owner.locals.get(monitoring_name(owner.name, name).upper())
    own = pou.result if pou.name.startswith("__get") else pou.locals.get(name.upper())
    monitored = kept.decl.monitored if isinstance(kept, VarSymbol) and kept.decl is not None else None
    if monitored is None or monitored.request is not None:
        return None
    if not isinstance(kept, VarSymbol) or not isinstance(own, VarSymbol) or kept.type is None:
        return None
    target = ast.Name(name=kept.name)
    target.symbol, target.type = kept, kept.type

    def keep() -> None:
        assert kept.type is not None
        place, value = b.target(target), b.places[id(own)]
        b.touch(place)
        scalar = scalar_of(kept.type)
        if scalar is not None:
            b.emit(ir.Store(place, ir.Load(scalar, value)))
        else:
            assign.copy_place(b, place, kept.type, value, kept.type)

    return keep
