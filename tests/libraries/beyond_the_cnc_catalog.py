"""What SM3_CNC has beyond the catalog, by the documentation of today's SoftMotion."""

BLOCKS: dict[str, dict[str, dict[str, str]]] = {}
STRUCTURES: dict[str, dict[str, str]] = {}
