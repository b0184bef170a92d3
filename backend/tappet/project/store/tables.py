"""Tables of the project store, and the metadata that the server's own tables join."""

from __future__ import annotations

from datetime import UTC, datetime

from sqlalchemy import (
    JSON,
    BigInteger,
    Boolean,
    Column,
    DateTime,
    Dialect,
    ForeignKey,
    ForeignKeyConstraint,
    Index,
    Integer,
    LargeBinary,
    MetaData,
    String,
    Table,
    Text,
    TypeDecorator,
    false,
    text,
)

metadata = MetaData(
    naming_convention={
        "ix": "ix_%(table_name)s_%(column_0_N_name)s",
        "uq": "uq_%(table_name)s_%(column_0_N_name)s",
        "ck": "ck_%(table_name)s_%(constraint_name)s",
        "fk": "fk_%(table_name)s_%(column_0_N_name)s_%(referred_table_name)s",
        "pk": "pk_%(table_name)s",
    }
)
"""All tables of the database; constraint names are fixed by rule so that migrations can name them."""


class UtcDateTime(TypeDecorator[datetime]):
    """A moment; kept as UTC without zone, because SQLite knows none, and given back with zone."""

    impl = DateTime
    cache_ok = True

    def process_bind_param(self, value: datetime | None, dialect: Dialect) -> datetime | None:
        """To the database."""
        return value.astimezone(UTC).replace(tzinfo=None) if value is not None else None

    def process_result_value(self, value: datetime | None, dialect: Dialect) -> datetime | None:
        """From the database."""
        return value.replace(tzinfo=UTC) if value is not None else None


projects = Table(
    "projects",
    metadata,
    Column("id", String(32), primary_key=True),
    Column("name", String(200), nullable=False),
    Column("name_key", String(600), nullable=False),
    Column("description", Text, nullable=False),
    Column("revision", Integer, nullable=False),
    Column("created_at", UtcDateTime, nullable=False),
    Column("created_by", String(64), nullable=False),
    Column("changed_at", UtcDateTime, nullable=False),
    Column("changed_by", String(64), nullable=False),
    Column("deleted_at", UtcDateTime, nullable=True),
)
"""One row a project. `revision` counts its changes; the row is locked while a change is written."""

_names_in_use = Index("uq_projects_name_key", projects.c.name_key, unique=True)


def complete_for(dialect: str) -> None:
    """Say what only databases of this kind have: an argument of a dialect loads it, PostgreSQL's in 30 ms."""
    _names_in_use.dialect_kwargs[f"{dialect}_where"] = text("deleted_at IS NULL")


changes = Table(
    "project_changes",
    metadata,
    Column("project_id", String(32), ForeignKey("projects.id", ondelete="CASCADE"), primary_key=True),
    Column("revision", Integer, primary_key=True, autoincrement=False),
    Column("action", String(32), nullable=False),
    Column("author", String(64), nullable=False),
    Column("at", UtcDateTime, nullable=False),
    Column("comment", Text, nullable=False),
    Column("autosave", Boolean, nullable=False),
    Column("undoes", Integer, nullable=True),
)
"""One row a change of a project: what a transaction did, to one object or to many. `undoes` is the revision
of the change that this one takes back."""

objects = Table(
    "project_objects",
    metadata,
    Column("project_id", String(32), ForeignKey("projects.id", ondelete="CASCADE"), primary_key=True),
    Column("id", String(32), primary_key=True),
    Column("parent_id", String(32), nullable=True),
    Column("kind", String(64), nullable=False),
    Column("subkind", String(32), nullable=True),
    Column("name", String(200), nullable=False),
    Column("position", BigInteger, nullable=False),
    Column("revision", Integer, nullable=False),
    Column("data", JSON, nullable=False),
    Column("excluded", Boolean, nullable=False, server_default=false()),
    Index("ix_project_objects_project_id_parent_id_position", "project_id", "parent_id", "position"),
)
"""The objects as they are now. `position` orders siblings and has gaps, so that a move writes one row.
`subkind` and `excluded` follow from `data`: the tree is shown without reading these."""

revisions = Table(
    "object_revisions",
    metadata,
    Column("project_id", String(32), primary_key=True),
    Column("object_id", String(32), primary_key=True),
    Column("revision", Integer, primary_key=True, autoincrement=False),
    Column("change", Integer, nullable=False),
    Column("deleted", Boolean, nullable=False),
    Column("parent_id", String(32), nullable=True),
    Column("kind", String(64), nullable=False),
    Column("name", String(200), nullable=False),
    Column("position", BigInteger, nullable=False),
    Column("data", JSON, nullable=False),
    ForeignKeyConstraint(
        ["project_id", "change"],
        ["project_changes.project_id", "project_changes.revision"],
        ondelete="CASCADE",
    ),
    Index("ix_object_revisions_project_id_change", "project_id", "change"),
)
"""Every state an object has had, whole; `deleted` marks the state in which it was removed."""

files = Table(
    "project_files",
    metadata,
    Column("project_id", String(32), ForeignKey("projects.id", ondelete="CASCADE"), primary_key=True),
    Column("path", String(1000), primary_key=True),
    Column("content", LargeBinary, nullable=False),
)
"""Files of an imported project folder that are no objects; given back at export."""
