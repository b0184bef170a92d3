"""Checks of good practice, one per file: each opens with what it checks, its source, and samples.

Imports only `lang`. `STATEMENT_RULES` run while a body is resolved, `POU_RULES` after it.
The Passes and Fails samples of the docstrings are run by a test and shown in the manual.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

STATEMENT_RULES: dict[type, list[Callable[[Any, Any], None]]] = {}
POU_RULES: list[Callable[[Any], None]] = []
