"""Slows password guessing: each failure after the first few doubles a pause.

Failures are counted for an account from one address, for an address, and, with more free ones, for an
account. Secrets of 256 bits (login links, the token of the first account) are not guessed and not locked.
"""

from __future__ import annotations

import hashlib
import ipaddress
from dataclasses import dataclass
from datetime import datetime, timedelta

from sqlalchemy import Connection, delete, insert, select, update
from sqlalchemy.exc import IntegrityError

from tappet.server.auth.accounts import name_key
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


PAIR = Allowance(free=4, longest=timedelta(minutes=5))
"""Of an account from one address: others, and the owner from elsewhere, are not held up."""
ADDRESS = Allowance(free=19, longest=timedelta(hours=1))
"""Of all accounts from one address; more free ones, because a plant may sit behind it."""
ACCOUNT = Allowance(free=99, longest=timedelta(minutes=1))
"""Of an account from all addresses: holds up those who guess from many of them."""
_ALLOWANCES = {"pair": PAIR, "address": ADDRESS, "account": ACCOUNT}


@dataclass(frozen=True, slots=True)
class Attempt:
    """Somebody gives a password for an account, existing or not, from an address.

    `known`: the account has a session from there. Only the failures of this pair count then, so that nobody
    locks those out who work.
    """

    username: str
    address: str
    known: bool = False

    def keys(self) -> list[str]:
        """What counts; names are hashed, so that typed passwords do not end in the table."""
        name, where = name_key(self.username), network(self.address)
        pair = f"pair:{_hashed(f'{name} {where}')}"
        return [pair] if self.known else [pair, f"address:{where}", f"account:{_hashed(name)}"]


def network(address: str) -> str:
    """What one client can choose its addresses from: all of IPv4 but one, and 64 bits of IPv6."""
    try:
        found = ipaddress.ip_address(address)
    except ValueError:
        return address[:64]
    if found.version == 4:
        return str(found)
    return str(found.ipv4_mapped or ipaddress.ip_network(f"{found}/64", strict=False))


def _hashed(text: str) -> str:
    return hashlib.sha256(text.encode("utf-8", "replace")).hexdigest()


def _allowance(key: str) -> Allowance:
    return _ALLOWANCES[key.partition(":")[0]]


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
    """Takes the attempt back. The pair starts again; address and account keep earlier failures, or one known
    password would free them."""
    for key in keys:
        mine = login_failures.c.key == key
        if _allowance(key) is PAIR:
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
