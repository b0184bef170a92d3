"""Password rules and argon2id hashes."""

from __future__ import annotations

import threading
import unicodedata
from dataclasses import dataclass

from argon2 import PasswordHasher
from argon2.exceptions import InvalidHashError, VerificationError

MIN_LENGTH = 10
"""Characters; NIST SP 800-63B asks for at least 8, without rules on kinds of characters."""
MAX_LENGTH = 1024
LEAST_SCORE = 3
"""Of zxcvbn: more than 10^8 guesses, as many as nobody makes against the pauses after wrong ones."""
MOST_ESTIMATED = 72
"""Characters that zxcvbn looks at; it takes long for more."""
OF_THIS_PRODUCT = ("tappet", "codesys", "twincat", "plc_prg")
"""What guessers try first."""


class WeakPasswordError(ValueError):
    """The password is not acceptable; the message says why."""


@dataclass(frozen=True, slots=True)
class HashCost:
    """Cost of one argon2id hash; the defaults are the low-memory profile of RFC 9106."""

    rounds: int = 3
    memory_kib: int = 65536
    lanes: int = 4


def check(password: str, username: str) -> None:
    """Raises WeakPasswordError for a password that must not be set."""
    if len(password) < MIN_LENGTH:
        raise WeakPasswordError(f"A password needs at least {MIN_LENGTH} characters.")
    if len(password) > MAX_LENGTH:
        raise WeakPasswordError(f"A password has at most {MAX_LENGTH} characters.")
    from zxcvbn import zxcvbn  # lists of words: only where a password is set

    found = zxcvbn(_normal(password)[:MOST_ESTIMATED], user_inputs=[username, *OF_THIS_PRODUCT])
    if found["score"] < LEAST_SCORE:
        said = [found["feedback"]["warning"], *found["feedback"]["suggestions"]]
        advice = " ".join(text for text in said if text) or "Add another word or two."
        raise WeakPasswordError(f"This password is guessed too soon. {advice}")


class Passwords:
    """Hashes and verifies; at most two at a time, so that logins cannot exhaust the machine's memory."""

    def __init__(self, cost: HashCost) -> None:
        self._hasher = PasswordHasher(cost.rounds, cost.memory_kib, cost.lanes)
        self._slots = threading.BoundedSemaphore(2)
        self._nobody = self._hasher.hash("the password of no account")

    def hash(self, password: str) -> str:
        """Encoded argon2id hash."""
        with self._slots:
            return self._hasher.hash(_normal(password))

    def verify(self, encoded: str | None, password: str) -> bool:
        """Whether the password matches; takes as long for an account that does not exist (None)."""
        with self._slots:
            try:
                matches = self._hasher.verify(encoded or self._nobody, _normal(password[: MAX_LENGTH + 1]))
            except (VerificationError, InvalidHashError):
                return False
            return matches and encoded is not None

    def outdated(self, encoded: str | None) -> bool:
        """Whether the hash was made at another cost and should be made again."""
        return encoded is not None and self._hasher.check_needs_rehash(encoded)


def _normal(password: str) -> str:
    """One form for what different keyboards send for the same characters."""
    return unicodedata.normalize("NFKC", password)
