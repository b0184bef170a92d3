"""What the coding rules take as right: prefixes of names, limits of size."""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True)
class CodingSettings:
    """Prefixes and limits; '' as prefix means that none is asked for."""

    kinds: dict[str, str] = field(
        default_factory=lambda: {"FUNCTION_BLOCK": "FB_", "FUNCTION": "", "PROGRAM": "", "INTERFACE": "I"}
    )
    """Prefix of an object by its kind."""
    types: dict[str, str] = field(default_factory=lambda: {"struct": "ST_", "enum": "E_", "union": "U_"})
    """Prefix of a type by what it is."""
    lists: str = "GVL_"
    """Prefix of a global variable list."""
    variables: dict[str, str] = field(
        default_factory=lambda: {"BOOL": "b", "pointer": "p", "reference": "r", "array": "a", "STRING": "s"}
    )
    """Prefix of a variable by its type."""
    longest_name: int = 30
    shortest_name: int = 2
    nesting: int = 4
    """Levels of IF, CASE and loops inside each other."""
    complexity: int = 15
    """McCabe's number of a body: decisions + 1."""
    statements: int = 100
    """Statements of a body."""
    parameters: int = 10
    """Inputs, outputs and in-outs of a POU."""
    operators: int = 8
    """Operators of one expression."""
    returns: int = 1
    """RETURN statements of a body."""
    magic: frozenset[int | float] = frozenset({0, 1, -1, 2, 10, 100, 1000})
    """Numbers that need no name."""


SETTINGS = CodingSettings()
"""What holds unless a project says otherwise."""
