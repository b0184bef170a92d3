"""The index of stored recordings of traces; their samples stay files."""

from alembic import op
from sqlalchemy import JSON, BigInteger, Column, DateTime, Index, Integer, String, Text

revision = "0008_trace_recordings"
down_revision = "0007_test_runs"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Create the table; recordings that are there already are found when the server lists them."""
    op.create_table(
        "trace_recordings",
        Column("id", String(32), primary_key=True),
        Column("title", Text, nullable=False),
        Column("comment", Text, nullable=False),
        Column("trace", Text, nullable=False),
        Column("trace_key", Text, nullable=False),
        Column("application", Text, nullable=False),
        Column("runtime_id", String(32), nullable=True),
        Column("runtime", Text, nullable=False),
        Column("project_id", String(32), nullable=True),
        Column("started_by", String(64), nullable=False),
        Column("started_at", DateTime, nullable=False),
        Column("ended_at", DateTime, nullable=True),
        Column("state", String(16), nullable=False),
        Column("problem", Text, nullable=True),
        Column("keep_bytes", BigInteger, nullable=True),
        Column("keep_seconds", Integer, nullable=True),
        Column("lost", BigInteger, nullable=False),
        Column("dropped", BigInteger, nullable=False),
        Column("bytes", BigInteger, nullable=False),
        Column("first_ns", BigInteger, nullable=True),
        Column("last_ns", BigInteger, nullable=True),
        Column("records", JSON, nullable=False),
        Index("ix_trace_recordings_started_at", "started_at"),
        Index("ix_trace_recordings_project_id", "project_id"),
    )


def downgrade() -> None:
    """Drop the table; each folder of a recording says what is in it."""
    op.drop_table("trace_recordings")
