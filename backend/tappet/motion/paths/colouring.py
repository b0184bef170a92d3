"""What the colours of a path stand for."""

from __future__ import annotations

from typing import Literal

Colouring = Literal["kind", "velocity", "acceleration", "curvature"]
