"""What Alembic runs around the migrations: always inside the transaction that `engine.migrate` holds."""

from alembic import context

from tappet.project.store.tables import metadata

context.configure(
    connection=context.config.attributes["connection"],
    target_metadata=metadata,
    render_as_batch=True,
)
context.run_migrations()
