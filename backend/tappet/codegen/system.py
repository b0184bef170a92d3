"""ST that is part of the product: compiled by itself, linked by the runtime, structures known to Python."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from tappet.codegen.compile_options import OptimiseOptions
from tappet.codegen.emit_module import EmitOptions, emit_module
from tappet.codegen.object_cache import ObjectCache
from tappet.core import passes
from tappet.core.lower import lower
from tappet.core.program import LoweringError
from tappet.lang import types as t
from tappet.lang.analysis.result import Analysis, AnalysisOptions
from tappet.lang.analysis.run import analyse
from tappet.lang.parser import parse
from tappet.lang.source import Source


@dataclass(slots=True)
class SystemBuild:
    """Compiled ST of the product with the layouts of its structures."""

    object: bytes = field(repr=False)
    analysis: Analysis = field(repr=False)

    def size_of(self, type_name: str) -> int:
        """Bytes of a type."""
        return _named_type(self.analysis, type_name).size

    def members_of(self, type_name: str) -> dict[str, tuple[int, int, str]]:
        """Members of a structure: name to (offset, size, type name)."""
        return layout_of(self.analysis, type_name)


class SystemBuildError(RuntimeError):
    """ST of the product does not compile; the message lists the errors."""


def build_system(sources: Iterable[Source]) -> SystemBuild:
    """Compile ST that stands alone: functions with attribute tappet_export and what they call, one object.

    Raises SystemBuildError. Global variables become imports `tappet.data.*` that the linker has to provide.
    """
    parsed = [parse(source) for source in sources]
    analysis = analyse([p.unit for p in parsed], AnalysisOptions(system=True))
    found = [d for p in parsed for d in p.diagnostics] + analysis.diagnostics
    errors = [d for d in found if d.severity == "error"]
    if errors:
        raise SystemBuildError("\n".join(str(d) for d in errors))
    try:
        lowered = lower(analysis)
    except LoweringError as error:
        raise SystemBuildError(f"{error.uri}: {error.message}") from error
    passes.run(lowered.module)
    names = list(lowered.module.functions)
    text = emit_module(lowered.module, names, EmitOptions(absolute_data=False), whole=True)
    return SystemBuild(ObjectCache(None).compile(text, OptimiseOptions()), analysis)


def _named_type(analysis: Analysis, type_name: str) -> t.Type:
    found = analysis.types.get(type_name.upper())
    if found is None:
        for pou in analysis.pous:
            if pou.name.upper() == type_name.upper() and pou.instance is not None:
                return pou.instance
        raise KeyError(f"there is no type {type_name}")
    return found


def layout_of(analysis: Analysis, type_name: str) -> dict[str, tuple[int, int, str]]:
    """Members of a structure or function block: name as declared to (offset, size, type name).

    Raises KeyError when there is no such type, TypeError when it has no members.
    """
    type_ = _named_type(analysis, type_name)
    if not isinstance(type_, t.Struct | t.FunctionBlock):
        raise TypeError(f"{type_name} has no members")
    return {m.name: (m.offset, m.type.size, str(m.type)) for m in type_.members.values()}
