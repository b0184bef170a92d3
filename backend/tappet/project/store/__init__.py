"""The working store of the server: projects, objects and every revision of them, in SQLite or PostgreSQL.

Stands on `tappet.project` and SQLAlchemy. Start reading at `store`, then `changes` (the one way to write).
The server's own tables join `metadata`; `migrations` is the one history of the whole schema.
"""

from tappet.project.store.records import StaleRevision
from tappet.project.store.store import Store
from tappet.project.store.tables import metadata

__all__ = ["StaleRevision", "Store", "metadata"]
