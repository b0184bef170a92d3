"""Moments as the API tells them."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta
from typing import Annotated

from msgspec import Meta

Instant = Annotated[datetime, Meta(tz=True)]
_EPOCH = datetime(1970, 1, 1, tzinfo=UTC)


def instant_of(timestamp_ns: int) -> datetime:
    """The moment of a unix time in ns, to the microsecond."""
    return _EPOCH + timedelta(microseconds=timestamp_ns // 1000)
