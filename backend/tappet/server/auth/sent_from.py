"""What an order comes from, as far as the request itself shows it.

The credential decides between browser and script, and the connection gives the address; the name of a
script is what it calls itself, and shown as such.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Literal

from starlette.requests import HTTPConnection

from tappet.server.auth.identity import Identity

_PRODUCT = re.compile(r"[A-Za-z0-9!#$%&'*+.^_`|~-]{1,40}(/[A-Za-z0-9.+_~-]{1,20})?(?=[\s(]|$)")
"""The first product of a User-Agent header (RFC 9110, 10.1.5)."""


@dataclass(frozen=True, slots=True)
class SentFrom:
    """Where an order of a user was given."""

    source: Literal["workbench", "api"]
    """The workbench: a browser session; the API: a bearer token."""
    program: str
    """Of a script: the product that its User-Agent header names, such as `curl/8.5.0`."""
    address: str


def sent_from(who: Identity, connection: HTTPConnection) -> SentFrom:
    """Where the request of this user was made."""
    if who.session_id is not None:
        return SentFrom("workbench", "", who.address)
    product = _PRODUCT.match(connection.headers.get("user-agent", ""))
    return SentFrom("api", product.group() if product else "", who.address)
