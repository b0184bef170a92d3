"""A project whose program calls one in Instruction List."""

from __future__ import annotations

from typing import Any

from playwright.sync_api import Page

from .api import fetch
from .conftest import Server
from .workbench import open_project

DECLARATION = """PROGRAM Instructions
VAR
    xAlways : BOOL := TRUE;
    nCount : INT;
    nIdle : INT;
END_VAR"""
BODY = """        LD      xAlways
        JMPC    onward
        LD      nIdle
        ST      nIdle
onward: LD      nCount
        ADD     1
        ST      nCount
        LD      0
        ST      nCount"""


def open_with_instructions(page: Page, server: Server, name: str, declaration: str, body: str) -> None:
    """A new project, open: PLC_PRG as given, and the program `Instructions`."""
    path = f"/projects/{fetch(page, server, 'POST', '/projects', data={'name': name})['id']}"
    objects = fetch(page, server, "GET", f"{path}/objects")
    program = next(item for item in objects if item["name"] == "PLC_PRG")
    application = next(item for item in objects if item["kind"] == "application")
    texts = {"declaration": declaration, "implementation": body}
    change: dict[str, Any] = {"base_revision": program["revision"], "data": texts}
    fetch(page, server, "PUT", f"{path}/objects/{program['id']}", data=change)
    data = {"declaration": DECLARATION, "implementation": BODY, "language": "IL"}
    made = {"parent_id": application["id"], "kind": "pou", "name": "Instructions", "data": data}
    fetch(page, server, "POST", f"{path}/objects", data=made)
    page.reload()
    open_project(page, name)
