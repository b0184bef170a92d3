"""What became of each act of the audit log, and how often a refused one was repeated."""

from alembic import op
from sqlalchemy import Column, DateTime, Integer, String, Text

revision = "0005_audit_results"
down_revision = "0004_excluded_objects"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Add the columns; what was recorded before, was recorded after it was done."""
    op.add_column("audit", Column("result", String(8), nullable=False, server_default="ok"))
    op.add_column("audit", Column("reason", Text, nullable=True))
    op.add_column("audit", Column("count", Integer, nullable=False, server_default="1"))
    op.add_column("audit", Column("last_at", DateTime, nullable=True))


def downgrade() -> None:
    """Drop the columns."""
    for column in ("last_at", "count", "reason", "result"):
        op.drop_column("audit", column)
