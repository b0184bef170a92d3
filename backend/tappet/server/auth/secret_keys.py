"""Random secrets, and what is stored of them."""

from __future__ import annotations

import hashlib
import secrets


def new_secret() -> str:
    """256 random bits, safe in URLs, cookies and headers."""
    return secrets.token_urlsafe(32)


def digest(secret: str) -> str:
    """What the database keeps. A plain hash is enough: 256 random bits cannot be guessed."""
    return hashlib.sha256(secret.encode("utf-8", "surrogatepass")).hexdigest()
