"""The last test run of each application."""

from alembic import op
from sqlalchemy import JSON, Column, DateTime, Float, ForeignKey, Integer, String

revision = "0007_test_runs"
down_revision = "0006_undone_changes"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Create the table."""
    op.create_table(
        "test_runs",
        Column("project_id", String(32), ForeignKey("projects.id", ondelete="CASCADE"), primary_key=True),
        Column("application_id", String(32), primary_key=True),
        Column("at", DateTime, nullable=False),
        Column("username", String(64), nullable=False),
        Column("revision", Integer, nullable=False),
        Column("digest", String(64), nullable=False),
        Column("seconds", Float, nullable=False),
        Column("report", JSON, nullable=False),
    )


def downgrade() -> None:
    """Drop the table."""
    op.drop_table("test_runs")
