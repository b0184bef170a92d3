"""An index for the place of an object among its siblings."""

from alembic import op

revision = "0003_sibling_order"
down_revision = "0002_accounts"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Create the index."""
    op.create_index(
        "ix_project_objects_project_id_parent_id_position",
        "project_objects",
        ["project_id", "parent_id", "position"],
    )


def downgrade() -> None:
    """Drop the index."""
    op.drop_index("ix_project_objects_project_id_parent_id_position", "project_objects")
