"""Projects, their objects, and every revision of them."""

import sqlalchemy as sa
from alembic import op

revision = "0001_projects"
down_revision = None
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Create the tables of the project store."""
    op.create_table(
        "projects",
        sa.Column("id", sa.String(32), nullable=False),
        sa.Column("name", sa.String(200), nullable=False),
        sa.Column("name_key", sa.String(600), nullable=False),
        sa.Column("description", sa.Text, nullable=False),
        sa.Column("revision", sa.Integer, nullable=False),
        sa.Column("created_at", sa.DateTime, nullable=False),
        sa.Column("created_by", sa.String(64), nullable=False),
        sa.Column("changed_at", sa.DateTime, nullable=False),
        sa.Column("changed_by", sa.String(64), nullable=False),
        sa.Column("deleted_at", sa.DateTime, nullable=True),
        sa.PrimaryKeyConstraint("id", name="pk_projects"),
    )
    op.create_index(
        "uq_projects_name_key",
        "projects",
        ["name_key"],
        unique=True,
        sqlite_where=sa.text("deleted_at IS NULL"),
        postgresql_where=sa.text("deleted_at IS NULL"),
    )
    op.create_table(
        "project_changes",
        sa.Column("project_id", sa.String(32), nullable=False),
        sa.Column("revision", sa.Integer, nullable=False, autoincrement=False),
        sa.Column("action", sa.String(32), nullable=False),
        sa.Column("author", sa.String(64), nullable=False),
        sa.Column("at", sa.DateTime, nullable=False),
        sa.Column("comment", sa.Text, nullable=False),
        sa.Column("autosave", sa.Boolean, nullable=False),
        sa.PrimaryKeyConstraint("project_id", "revision", name="pk_project_changes"),
        sa.ForeignKeyConstraint(
            ["project_id"], ["projects.id"], "fk_project_changes_project_id_projects", ondelete="CASCADE"
        ),
    )
    op.create_table(
        "project_objects",
        sa.Column("project_id", sa.String(32), nullable=False),
        sa.Column("id", sa.String(32), nullable=False),
        sa.Column("parent_id", sa.String(32), nullable=True),
        sa.Column("kind", sa.String(64), nullable=False),
        sa.Column("subkind", sa.String(32), nullable=True),
        sa.Column("name", sa.String(200), nullable=False),
        sa.Column("position", sa.BigInteger, nullable=False),
        sa.Column("revision", sa.Integer, nullable=False),
        sa.Column("data", sa.JSON, nullable=False),
        sa.PrimaryKeyConstraint("project_id", "id", name="pk_project_objects"),
        sa.ForeignKeyConstraint(
            ["project_id"], ["projects.id"], "fk_project_objects_project_id_projects", ondelete="CASCADE"
        ),
    )
    op.create_table(
        "object_revisions",
        sa.Column("project_id", sa.String(32), nullable=False),
        sa.Column("object_id", sa.String(32), nullable=False),
        sa.Column("revision", sa.Integer, nullable=False, autoincrement=False),
        sa.Column("change", sa.Integer, nullable=False),
        sa.Column("deleted", sa.Boolean, nullable=False),
        sa.Column("parent_id", sa.String(32), nullable=True),
        sa.Column("kind", sa.String(64), nullable=False),
        sa.Column("name", sa.String(200), nullable=False),
        sa.Column("position", sa.BigInteger, nullable=False),
        sa.Column("data", sa.JSON, nullable=False),
        sa.PrimaryKeyConstraint("project_id", "object_id", "revision", name="pk_object_revisions"),
        sa.ForeignKeyConstraint(
            ["project_id", "change"],
            ["project_changes.project_id", "project_changes.revision"],
            "fk_object_revisions_project_id_change_project_changes",
            ondelete="CASCADE",
        ),
    )
    op.create_index("ix_object_revisions_project_id_change", "object_revisions", ["project_id", "change"])
    op.create_table(
        "project_files",
        sa.Column("project_id", sa.String(32), nullable=False),
        sa.Column("path", sa.String(1000), nullable=False),
        sa.Column("content", sa.LargeBinary, nullable=False),
        sa.PrimaryKeyConstraint("project_id", "path", name="pk_project_files"),
        sa.ForeignKeyConstraint(
            ["project_id"], ["projects.id"], "fk_project_files_project_id_projects", ondelete="CASCADE"
        ),
    )


def downgrade() -> None:
    """Drop the tables of the project store."""
    for table in ("project_files", "object_revisions", "project_objects", "project_changes", "projects"):
        op.drop_table(table)
