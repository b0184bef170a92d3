"""The working store of the server: projects, objects and every revision of them, in SQLite or PostgreSQL.

Stands on `tappet.project` and SQLAlchemy. Start reading at `store`, then `changes` (the one way to write).
The server's own tables join `tables.metadata`; `migrations` is the one history of the whole schema.
"""
