"""Slows password guessing: each failure after the first few doubles a pause, per account and per address."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from datetime import datetime, timedelta

from sqlalchemy import Connection, delete, insert, select, update
from sqlalchemy.exc import IntegrityError

from tappet.server.tables import login_failures

FORGET_AFTER = timedelta(hours=24)
"""Failures this old no longer count."""


@dataclass(frozen=True, slots=True)
class Allowance:
    """How many failures are free and how long the pause may grow."""

    free: int
    longest: timedelta

    def pause(self, failures: int) -> timedelta:
        """Pause after so many failures: 0, then 1 s, 2 s, 4 s ... up to the longest."""
        if failures <= self.free:
            return timedelta(0)
        return min(timedelta(seconds=2 ** min(failures - self.free - 1, 20)), self.longest)


ACCOUNT = Allowance(free=4, longest=timedelta(minutes=5))
"""Short at most, because anybody can lock anybody's account."""
ADDRESS = Allowance(free=19, longest=timedelta(hours=1))
"""More free ones, because a plant may sit behind one address."""


def account_key(username: str) -> str:
    """Key of an account, existing or not; hashed, so that typed passwords do not end in the table."""
    return "account:" + hashlib.sha256(username.casefold().encode("utf-8", "replace")).hexdigest()


def address_key(address: str) -> str:
    """Key of a client address."""
    return "address:" + address[:64]


def _allowance(key: str) -> Allowance:
    return ACCOUNT if key.startswith("account:") else ADDRESS


def wait(db: Connection, keys: list[str], now: datetime) -> timedelta:
    """How long the next attempt must wait; zero: it may be made now."""
    rows = db.scalars(select(login_failures.c.locked_until).where(login_failures.c.key.in_(keys)))
    return max((until - now for until in rows if until is not None and until > now), default=timedelta(0))


def attempt(db: Connection, keys: list[str], now: datetime) -> timedelta:
    """Counts an attempt as failed before its password is looked at, so that parallel guesses gain nothing.

    Returns how long the attempt must wait instead (then nothing is counted); only zero lets it continue.
    """
    db.execute(delete(login_failures).where(login_failures.c.last_at < now - FORGET_AFTER))
    pause = wait(db, keys, now)
    if pause:
        return pause
    for key in keys:
        count = _add_one(db, key, now)
        pause = _allowance(key).pause(count)
        db.execute(
            update(login_failures)
            .where(login_failures.c.key == key)
            .values(last_at=now, locked_until=now + pause if pause else None)
        )
    return timedelta(0)


def succeeded(db: Connection, keys: list[str]) -> None:
    """Takes the attempt back. The account starts again; the address keeps its earlier failures, or one known
    account would free it."""
    for key in keys:
        mine = login_failures.c.key == key
        if _allowance(key) is ACCOUNT:
            db.execute(delete(login_failures).where(mine))
        else:
            db.execute(
                update(login_failures).where(mine).values(count=login_failures.c.count - 1, locked_until=None)
            )


def _add_one(db: Connection, key: str, now: datetime) -> int:
    mine = login_failures.c.key == key
    more = update(login_failures).where(mine).values(count=login_failures.c.count + 1)
    if db.execute(more).rowcount == 0:
        try:
            with db.begin_nested():
                db.execute(insert(login_failures).values(key=key, count=1, last_at=now))
        except IntegrityError:
            db.execute(more)
    return db.scalar(select(login_failures.c.count).where(mine)) or 1
