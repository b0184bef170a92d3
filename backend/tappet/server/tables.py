"""Database tables of accounts, audit, test runs, recordings, runtimes, beside the project store."""

from __future__ import annotations

from sqlalchemy import (
    JSON,
    BigInteger,
    Boolean,
    Column,
    Float,
    ForeignKey,
    Index,
    Integer,
    String,
    Table,
    Text,
)

from tappet.project.store.tables import UtcDateTime, metadata

users = Table(
    "users",
    metadata,
    Column("id", String(32), primary_key=True),
    Column("username", String(64), nullable=False),
    Column("username_key", String(128), nullable=False, unique=True),
    Column("password_hash", String(256), nullable=True),
    Column("role", String(16), nullable=False),
    Column("disabled", Boolean, nullable=False, default=False),
    Column("created_at", UtcDateTime, nullable=False),
    Column("last_login_at", UtcDateTime, nullable=True),
)

sessions = Table(
    "sessions",
    metadata,
    Column("id", String(32), primary_key=True),
    Column("secret_digest", String(64), nullable=False, unique=True),
    Column("user_id", String(32), ForeignKey("users.id", ondelete="CASCADE"), nullable=False, index=True),
    Column("created_at", UtcDateTime, nullable=False),
    Column("seen_at", UtcDateTime, nullable=False),
    Column("address", String(64), nullable=False),
    Column("browser", String(256), nullable=False),
)

api_tokens = Table(
    "api_tokens",
    metadata,
    Column("id", String(32), primary_key=True),
    Column("secret_digest", String(64), nullable=False, unique=True),
    Column("user_id", String(32), ForeignKey("users.id", ondelete="CASCADE"), nullable=False, index=True),
    Column("name", String(100), nullable=False),
    Column("role", String(16), nullable=False),
    Column("created_at", UtcDateTime, nullable=False),
    Column("used_at", UtcDateTime, nullable=True),
    Column("expires_at", UtcDateTime, nullable=True),
)

login_failures = Table(
    "login_failures",
    metadata,
    Column("key", String(80), primary_key=True),
    Column("count", Integer, nullable=False),
    Column("last_at", UtcDateTime, nullable=False, index=True),
    Column("locked_until", UtcDateTime, nullable=True),
)

user_settings = Table(
    "user_settings",
    metadata,
    Column("user_id", String(32), ForeignKey("users.id", ondelete="CASCADE"), primary_key=True),
    Column("key", String(120), primary_key=True),
    Column("value", JSON, nullable=False),
    Column("changed_at", UtcDateTime, nullable=False),
)

audit = Table(
    "audit",
    metadata,
    Column("id", Integer, primary_key=True, autoincrement=True),
    Column("at", UtcDateTime, nullable=False),
    Column("username", String(64), nullable=False),
    Column("address", String(64), nullable=False),
    Column("action", String(40), nullable=False),
    Column("subject", Text, nullable=False),
    Column("project_id", String(32), nullable=True),
    Column("runtime_id", String(32), nullable=True),
    Column("old_value", Text, nullable=True),
    Column("new_value", Text, nullable=True),
    Column("result", String(8), nullable=False, default="ok", server_default="ok"),
    Column("reason", Text, nullable=True),
    Column("count", Integer, nullable=False, default=1, server_default="1"),
    Column("last_at", UtcDateTime, nullable=True),
    Index("ix_audit_action", "action"),
)

test_runs = Table(
    "test_runs",
    metadata,
    Column("project_id", String(32), ForeignKey("projects.id", ondelete="CASCADE"), primary_key=True),
    Column("application_id", String(32), primary_key=True),
    Column("at", UtcDateTime, nullable=False),
    Column("username", String(64), nullable=False),
    Column("revision", Integer, nullable=False),
    Column("digest", String(64), nullable=False),
    Column("seconds", Float, nullable=False),
    Column("report", JSON, nullable=False),
)
"""The last one of each application: the revision of the project, and the digest of what was tested."""

trace_recordings = Table(
    "trace_recordings",
    metadata,
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
    Column("started_at", UtcDateTime, nullable=False),
    Column("ended_at", UtcDateTime, nullable=True),
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
"""What lists show of stored recordings; their folders hold the samples, and all that makes a row anew."""

runtimes = Table(
    "runtimes",
    metadata,
    Column("id", String(32), primary_key=True),
    Column("name", String(100), nullable=False, unique=True),
    Column("url", String(500), nullable=False),
    Column("token", String(500), nullable=False),
    Column("created_at", UtcDateTime, nullable=False),
)
