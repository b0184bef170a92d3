"""Run as a module: prints the OpenAPI document of the product, as the front end keeps it."""

from __future__ import annotations

import json
import sys

from fastapi import FastAPI

from tappet.server.app import create_app
from tappet.server.openapi import document
from tappet.server.settings import ServerSettings


def text(app: FastAPI) -> str:
    """The document as it is kept in the front end: sorted, one line per value, so that diffs read well."""
    return json.dumps(document(app), indent=2, ensure_ascii=False, sort_keys=True) + "\n"


if __name__ == "__main__":
    sys.stdout.write(text(create_app(ServerSettings())))
