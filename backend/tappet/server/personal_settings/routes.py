"""Personal settings."""

from __future__ import annotations

from typing import Annotated

from fastapi import Body, Path
from pydantic import JsonValue

from tappet.server.dependencies import DatabaseDep, Viewer
from tappet.server.personal_settings import service as personal_settings
from tappet.server.routing import Router

router = Router(prefix="/me/settings", tags=["settings"])
Key = Annotated[
    str, Path(pattern=r"^[A-Za-z0-9._:-]{1,120}$", description="For example `layout.<project id>`.")
]


@router.get("/{key}")
def read_setting(key: Key, who: Viewer, database: DatabaseDep) -> JsonValue:
    """A setting of one's own as the JSON that was stored; null when never set."""
    value: JsonValue = database.read(lambda db: personal_settings.get(db, who.user_id, key))
    return value


@router.put("/{key}")
def write_setting(
    key: Key, who: Viewer, database: DatabaseDep, body: Annotated[JsonValue, Body()] = None
) -> JsonValue:
    """Store any JSON, at most 256 KiB, as a setting of one's own."""
    database.write(lambda db: personal_settings.put(db, who.user_id, key, body))
    return body
