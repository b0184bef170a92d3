"""Whether the server works."""

from __future__ import annotations

from sqlalchemy import select

from tappet import __version__
from tappet.server.dependencies import DatabaseDep
from tappet.server.routing import Router
from tappet.server.shapes import Reply

router = Router(tags=["health"])


class Health(Reply):
    """The server answers and reaches its database."""

    status: str
    version: str


@router.get("/health")
def health(database: DatabaseDep) -> Health:
    """Answers 200 when the server and its database work. Open to all."""
    database.read(lambda db: db.scalar(select(1)))
    return Health(status="ok", version=__version__)
