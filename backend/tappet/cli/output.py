"""How commands speak to machines and to people."""

from __future__ import annotations

import json
from typing import Any


def show_json(value: Any) -> None:
    """Writes one JSON document."""
    print(json.dumps(value, indent=2, ensure_ascii=False))


def counted(number: int, noun: str) -> str:
    """`1 object`, `2 objects`."""
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"
