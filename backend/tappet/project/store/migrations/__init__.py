"""Alembic migrations of the whole database; `engine.migrate` runs them at every start.

A new revision is a file in `versions` whose `down_revision` is the newest one before it.
"""
