"""Which change another one has undone."""

from alembic import op
from sqlalchemy import Column, Integer

revision = "0006_undone_changes"
down_revision = "0005_audit_results"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Add the column; before it no change of the tree could be undone."""
    op.add_column("project_changes", Column("undoes", Integer, nullable=True))


def downgrade() -> None:
    """Drop the column."""
    op.drop_column("project_changes", "undoes")
