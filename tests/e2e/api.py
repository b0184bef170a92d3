"""What a script of the same user does over the API while the browser shows the workbench."""

from __future__ import annotations

from typing import Any

from playwright.sync_api import Page

from .conftest import Server


def fetch(page: Page, server: Server, method: str, path: str, **body: Any) -> Any:
    """An answer of the API, as a script of the same user gets it."""
    headers = {"X-Tappet-Client": "1", "Origin": server.address}
    answer = page.request.fetch(f"{server.address}/api/v1{path}", method=method, headers=headers, **body)
    assert answer.ok, answer.text()
    if answer.status == 204:
        return None
    return answer.json() if "json" in answer.headers["content-type"] else answer.body()


def example(page: Page, server: Server) -> str:
    projects = fetch(page, server, "GET", "/projects")
    return f"/projects/{next(one['id'] for one in projects if one['name'] == 'Bottling line')}"


def stored(page: Page, server: Server, project: str, name: str) -> dict[str, Any]:
    """The object of a name, with its data."""
    item = next(one for one in fetch(page, server, "GET", f"{project}/objects") if one["name"] == name)
    return dict(fetch(page, server, "GET", f"{project}/objects/{item['id']}"))


def change(page: Page, server: Server, project: str, name: str, **data: Any) -> None:
    """A change of some data of an object that somebody else makes."""
    item = stored(page, server, project, name)
    body = {"base_revision": item["revision"], "data": item["data"] | data}
    fetch(page, server, "PUT", f"{project}/objects/{item['id']}", data=body)


def write(page: Page, server: Server, project: str, name: str, old: str, new: str) -> None:
    """A change of a text that somebody else makes."""
    data = stored(page, server, project, name)["data"]
    field = next(field for field in ("implementation", "declaration") if old in data.get(field, ""))
    change(page, server, project, name, **{field: data[field].replace(old, new, 1)})
