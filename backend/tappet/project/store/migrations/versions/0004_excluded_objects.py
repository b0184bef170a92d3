"""A column that says what the build leaves out, so that the tree shows it without reading the data."""

from alembic import op
from sqlalchemy import Boolean, Column, false

revision = "0004_excluded_objects"
down_revision = "0003_sibling_order"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Add the column; nothing was excluded before there was one."""
    op.add_column("project_objects", Column("excluded", Boolean, nullable=False, server_default=false()))


def downgrade() -> None:
    """Drop the column."""
    op.drop_column("project_objects", "excluded")
