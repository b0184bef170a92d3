"""Static analysis as a project has it: which coding rules run, as what, with which prefixes and limits."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from types import MappingProxyType

PREFIXES: Mapping[str, str] = MappingProxyType(
    {
        "PROGRAM": "",
        "FUNCTION_BLOCK": "FB_",
        "FUNCTION": "",
        "INTERFACE": "I",
        "STRUCT": "ST_",
        "ENUM": "E_",
        "UNION": "U_",
        "GVL": "GVL_",
        "POINTER": "p",
        "REFERENCE": "r",
        "ARRAY": "a",
        "STRING": "s",
        "BOOL": "b",
    }
    | dict.fromkeys(("BYTE", "WORD", "DWORD", "LWORD"), "")
    | dict.fromkeys(("SINT", "USINT", "INT", "UINT", "DINT", "UDINT", "LINT", "ULINT"), "")
    | dict.fromkeys(("REAL", "LREAL", "TIME", "LTIME", "DATE", "TIME_OF_DAY", "DATE_AND_TIME"), "")
)
"""What the names of objects and variables begin with, by kind of object or type; '' asks for nothing."""


@dataclass(frozen=True, slots=True)
class CodingSettings:
    """Prefixes and limits of the coding rules."""

    prefixes: Mapping[str, str] = field(default_factory=lambda: dict(PREFIXES))
    longest_name: int = 30
    shortest_name: int = 2
    nesting: int = 4
    """Levels of IF, CASE and loops inside each other."""
    complexity: int = 15
    """McCabe's number of a body: decisions + 1."""
    cognitive: int = 20
    """Cognitive complexity of a body: see `rules.coding.cognitive_complexity`."""
    statements: int = 100
    """Statements of a body."""
    parameters: int = 10
    """Inputs, outputs and in-outs of a POU."""
    operators: int = 8
    """Operators of one expression."""
    returns: int = 1
    """RETURN statements of a body."""


LIMITS: Mapping[str, int] = MappingProxyType(
    {part.name: part.default for part in fields(CodingSettings) if isinstance(part.default, int)}
)
"""The limits that a project can set, with what holds unless it does."""

_OBJECTS = ("PROGRAM", "FUNCTION_BLOCK", "FUNCTION", "INTERFACE")
_TYPES = ("STRUCT", "ENUM", "UNION")
OF_RULE: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "S1001": _OBJECTS,
        "S1002": _TYPES,
        "S1003": ("GVL",),
        "S1004": tuple(key for key in PREFIXES if key not in (*_OBJECTS, *_TYPES, "GVL")),
        "S1005": ("longest_name",),
        "S1006": ("shortest_name",),
        "S1202": ("returns",),
        "S1213": ("operators",),
        "S1301": ("nesting",),
        "S1302": ("complexity",),
        "S1303": ("parameters",),
        "S1304": ("statements",),
        "S1306": ("cognitive",),
    }
)
"""Which prefixes and limits a rule looks at."""


@dataclass(frozen=True, slots=True)
class StaticAnalysis:
    """The coding rules that are switched on."""

    codes: frozenset[str] = frozenset()
    errors: frozenset[str] = frozenset()
    """Those of `codes` whose findings are errors; the others give warnings."""
    settings: CodingSettings = CodingSettings()


NO_RULES = StaticAnalysis()


def static_analysis(
    rules: Mapping[str, str], prefixes: Mapping[str, str], limits: Mapping[str, int]
) -> StaticAnalysis:
    """The choice of a project: `rules` gives `warning` or `error` to codes; what is not named stays as it is.

    Names that are not known here, from a newer version, say, have no effect.
    """
    return StaticAnalysis(
        frozenset(rules),
        frozenset(code for code, severity in rules.items() if severity == "error"),
        CodingSettings(
            {key: prefixes.get(key, usual) for key, usual in PREFIXES.items()},
            **{key: limits.get(key, usual) for key, usual in LIMITS.items()},
        ),
    )
