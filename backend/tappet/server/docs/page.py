"""The REST interface as a page to read: no scripts, nothing from other servers."""

from __future__ import annotations

from html import escape
from typing import Any

STYLE = """
body { font: 14px/1.5 system-ui, sans-serif; max-width: 72em; margin: 2em auto; padding: 0 1em }
h2 { margin-top: 2em; border-bottom: 1px solid #8885 }
code, pre { font: 13px/1.5 ui-monospace, monospace }
.operation { margin: 1.2em 0; padding-left: 1em; border-left: 3px solid #8885 }
.operation h3 { margin: 0 0 .3em; font-size: 14px }
.method { display: inline-block; min-width: 4.5em; font-weight: 700 }
table { border-collapse: collapse } td, th { text-align: left; padding: 2px 1em 2px 0; vertical-align: top }
:root { color-scheme: light dark }
"""
INTRODUCTION = """
<p>Send <code>Authorization: Bearer &lt;token&gt;</code>; make tokens in the workbench under your user name,
or with <code>POST /api/v1/auth/tokens</code>. Errors are problem details (RFC 9457): test <code>type</code>,
show <code>detail</code>. For programs there is <a href="/api/v1/openapi.json">openapi.json</a>.</p>
"""


def render(document: dict[str, Any]) -> str:
    """An HTML page of an OpenAPI document."""
    by_tag: dict[str, list[str]] = {}
    for path, operations in document["paths"].items():
        for method, operation in operations.items():
            tag = (operation.get("tags") or ["other"])[0]
            by_tag.setdefault(tag, []).append(_operation(method, path, operation))
    sections = "".join(f"<h2>{escape(tag)}</h2>{''.join(parts)}" for tag, parts in sorted(by_tag.items()))
    schemas = "".join(_schema(name, schema) for name, schema in document["components"]["schemas"].items())
    title = f"{document['info']['title']} {document['info']['version']}: REST interface"
    return (
        f'<!doctype html><html lang="en"><head><meta charset="utf-8"><title>{escape(title)}</title>'
        f"<style>{STYLE}</style></head><body><h1>{escape(title)}</h1>{INTRODUCTION}{sections}"
        f"<h2>Shapes</h2>{schemas}</body></html>"
    )


def _operation(method: str, path: str, operation: dict[str, Any]) -> str:
    rows = [
        (parameter["name"], f"{parameter['in']}: {_type(parameter.get('schema', {}))}", parameter)
        for parameter in operation.get("parameters", [])
    ]
    body = operation.get("requestBody", {}).get("content", {})
    rows += [("body", _type(content.get("schema", {})), {}) for content in body.values()]
    for status, response in operation.get("responses", {}).items():
        if status.startswith("2"):
            content = response.get("content", {})
            shape = next((_type(c.get("schema", {})) for c in content.values()), "nothing")
            rows.append((f"answer {status}", shape, {}))
    ways_in = [roles for way in operation.get("security", ()) for roles in way.values()]
    rows.append(("role", escape(ways_in[0][0]) if ways_in else "none: open to all", {}))
    table = "".join(
        f"<tr><td><code>{escape(name)}</code></td><td>{shape}</td>"
        f"<td>{escape(facts.get('description') or '')}</td></tr>"
        for name, shape, facts in rows
    )
    return (
        f'<div class="operation"><h3><span class="method">{method.upper()}</span>'
        f"<code>{escape(path)}</code></h3>"
        f"<p>{escape(operation.get('description') or '')}</p><table>{table}</table></div>"
    )


def _schema(name: str, schema: dict[str, Any]) -> str:
    required = set(schema.get("required", []))
    rows = "".join(
        f"<tr><td><code>{escape(field)}</code>{'' if field in required else ' (optional)'}</td>"
        f"<td>{_type(facts)}</td><td>{escape(facts.get('description') or '')}</td></tr>"
        for field, facts in schema.get("properties", {}).items()
    )
    return (
        f'<div class="operation" id="{escape(name)}"><h3><code>{escape(name)}</code></h3>'
        f"<p>{escape(schema.get('description') or '')}</p><table>{rows or _type(schema)}</table></div>"
    )


def _type(schema: dict[str, Any]) -> str:
    if "$ref" in schema:
        name = escape(schema["$ref"].rpartition("/")[2])
        return f'<a href="#{name}">{name}</a>'
    for union in ("anyOf", "oneOf"):
        if union in schema:
            return " | ".join(_type(option) for option in schema[union])
    if "enum" in schema:
        return " | ".join(f"<code>{escape(repr(value))}</code>" for value in schema["enum"])
    if "const" in schema:
        return f"<code>{escape(repr(schema['const']))}</code>"
    if schema.get("type") == "array":
        return f"list of {_type(schema.get('items', {}))}"
    return escape(str(schema.get("type", "any")))
