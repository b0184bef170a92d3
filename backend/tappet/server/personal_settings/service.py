"""Settings of a user as JSON by key: layouts, watch lists, theme, language."""

from __future__ import annotations

import json
from datetime import UTC, datetime
from typing import Any

from sqlalchemy import Connection, func, insert, select, update

from tappet.server.problems import Problem
from tappet.server.tables import user_settings

MAX_BYTES = 256 * 1024
"""Largest value as JSON text."""
MAX_KEYS = 1000
"""Keys of one user."""


def get(db: Connection, user_id: str, key: str) -> Any:
    """The value; None when never set."""
    mine = (user_settings.c.user_id == user_id) & (user_settings.c.key == key)
    return db.scalar(select(user_settings.c.value).where(mine))


def put(db: Connection, user_id: str, key: str, value: Any) -> None:
    """Stores a value; raises problems when it is too large or no JSON."""
    try:
        size = len(json.dumps(value, allow_nan=False).encode())
    except ValueError:
        raise Problem(
            422, "invalid-request", "A setting holds only what JSON has: no NaN, no Infinity."
        ) from None
    if size > MAX_BYTES:
        raise Problem(
            413, "setting-too-large", f"The setting has {size} bytes; at most {MAX_BYTES} are kept."
        )
    mine = (user_settings.c.user_id == user_id) & (user_settings.c.key == key)
    now = datetime.now(UTC)
    if db.execute(update(user_settings).where(mine).values(value=value, changed_at=now)).rowcount:
        return
    count = db.scalar(select(func.count()).where(user_settings.c.user_id == user_id)) or 0
    if count >= MAX_KEYS:
        raise Problem(409, "too-many-settings", f"A user has at most {MAX_KEYS} settings.")
    db.execute(insert(user_settings).values(user_id=user_id, key=key, value=value, changed_at=now))
