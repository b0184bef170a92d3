"""The core form of an application as text, to be compared."""

from __future__ import annotations

from dataclasses import fields

from tappet.core import ir


def functions(module: ir.Module) -> dict[str, str]:
    """Every function that is called, or called from outside, by name."""
    found: dict[str, str] = {}
    todo = [name for name, function in module.functions.items() if function.exported]
    while todo:
        name = todo.pop()
        if name not in found and name in module.functions:
            text = _Text(module)
            found[name] = text.function(module.functions[name])
            todo += text.called
    return found


_LEFT_OUT = {"weight", "callees", "loops", "locals"}


class _Text:
    """The text of one function."""

    def __init__(self, module: ir.Module) -> None:
        self.module = module
        self.called: list[str] = []
        self.numbers: dict[int, int] = {}

    def function(self, function: ir.Function) -> str:
        parts = [
            f"{f.name}={self.of(getattr(function, f.name))}"
            for f in fields(function)
            if f.name not in _LEFT_OUT
        ]
        return "\n".join(parts)

    def of(self, entity: object) -> str:
        if isinstance(entity, ir.Local):
            number = self.numbers.setdefault(id(entity), len(self.numbers))
            return f"local{number}:{entity.name}:{entity.size}:{entity.align}:{entity.type}"
        if isinstance(entity, (ir.Call, ir.FunctionAddress)):
            self.called.append(entity.function if isinstance(entity, ir.Call) else entity.name)
        if isinstance(entity, ir.VirtualMethod):
            self.called += entity.targets.values()
            return f"{entity.key} {sorted(entity.targets.items())}"
        if isinstance(entity, (list, tuple)):
            return "[" + "\n".join(self.of(part) for part in entity) + "]"
        if isinstance(entity, (set, frozenset)):
            return str(sorted(map(self.of, entity)))
        if isinstance(entity, dict):
            return str(sorted(self.of(key) + ":" + self.of(value) for key, value in entity.items()))
        names = [f.name for f in fields(entity)] if isinstance(entity, _NODES) else []
        if names:
            return f"{entity.__class__.__name__}({', '.join(self.of(getattr(entity, n)) for n in names)})"
        return repr(entity)


_NODES = (ir.Expr, ir.Stmt, ir.Place, ir.Subscript, ir.Indirect, ir.SwitchCase, ir.Parameter)
