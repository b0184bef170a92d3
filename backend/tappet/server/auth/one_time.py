"""Secrets that work once: the token for the first account, and login links."""

from __future__ import annotations

import hmac
import threading
from datetime import UTC, datetime, timedelta

from tappet.server.auth.secret_keys import digest, new_secret


class OneTimeSecrets:
    """Secrets by purpose, in memory only: a restart ends them all."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._open: dict[str, tuple[str, datetime | None]] = {}

    def issue(self, purpose: str, life: timedelta | None = None) -> str:
        """A new secret for `purpose`; an older one for the same purpose ends. `life` None: until used."""
        secret = new_secret()
        until = datetime.now(UTC) + life if life is not None else None
        with self._lock:
            self._open[purpose] = (digest(secret), until)
        return secret

    def matches(self, purpose: str, secret: str) -> bool:
        """Whether `secret` is the open one, compared in constant time; it stays open."""
        with self._lock:
            stored, until = self._open.get(purpose, ("", None))
        same = hmac.compare_digest(stored, digest(secret))
        return same and (until is None or datetime.now(UTC) < until)

    def redeem(self, purpose: str, secret: str) -> bool:
        """Like `matches`, and ends the secret when it matches: only one of two callers gets True."""
        with self._lock:
            stored, until = self._open.get(purpose, ("", None))
            if not hmac.compare_digest(stored, digest(secret)):
                return False
            del self._open[purpose]
        return until is None or datetime.now(UTC) < until

    def cancel(self, purpose: str) -> None:
        """Ends the open secret of `purpose`."""
        with self._lock:
            self._open.pop(purpose, None)
