"""Mends of a block that does not have what its interfaces demand."""

from __future__ import annotations

from collections.abc import Iterator

from tappet.lang import ast
from tappet.lang.services.describe import slice_of
from tappet.lang.services.fix_site import Site
from tappet.lang.services.results import CodeAction, Edit, NewMember
from tappet.lang.symbols import InterfaceSymbol, PouSymbol, PropertySymbol


def implement(site: Site) -> Iterator[CodeAction]:
    """Make the methods and properties of an interface that a block lacks (E0418), all of them at once."""
    name = site.facts["interface"]
    interface = site.snapshot.interfaces.get(name.upper())
    if interface is None:
        return
    wanted: list[NewMember] = []
    for other in site.snapshot.diagnostics:
        here = other.code == "E0418" and other.uri == site.diagnostic.uri and other.span == site.span
        if here and other.facts["interface"] == name:
            member = _member(interface, other.facts["member"])
            if member is not None:
                wanted.append(member)
    if not wanted:
        return
    title = f"Implement {', '.join(member.name for member in wanted)} of {name}"
    members = ", ".join(member.name for member in wanted)
    if len(site.view.text.segments) == 1 and site.view.text.segments[0].count is None:
        edit = _before_end(site, "".join(_as_text(member) for member in wanted))
        yield site.action("implement", title, edit, preferred=True, interface=name, members_text=members)
        return
    owner = site.view.text.segments[0].document
    yield site.action(
        "implement",
        title,
        preferred=True,
        members=tuple(wanted),
        owner=owner,
        interface=name,
        members_text=members,
    )


def _member(interface: InterfaceSymbol, name: str) -> NewMember | None:
    method = interface.methods.get(name.upper())
    if method is not None:
        return NewMember("method", method.name, _head(method))
    property_ = interface.properties.get(name.upper())
    if property_ is None:
        return None
    accessors = tuple(
        word for word, found in (("Get", property_.getter), ("Set", property_.setter)) if found is not None
    )
    return NewMember("property", property_.name, _property_head(property_), accessors)


def _head(method: PouSymbol) -> str:
    node, source = method.pou, method.source
    result = f" : {method.return_type}" if method.return_type is not None else ""
    if node is not None and source is not None and node.return_type is not None:
        result = f" : {slice_of(source, node.return_type.span)}"
    blocks = [slice_of(source, block.span) for block in node.blocks] if node is not None and source else []
    return "\n".join([f"METHOD {method.name}{result}", *blocks])


def _property_head(symbol: PropertySymbol) -> str:
    return f"PROPERTY {symbol.name} : {symbol.type}"


def _as_text(member: NewMember) -> str:
    """A member in a plain text, before the end of its block."""
    if member.kind == "method":
        return f"\n{member.declaration}\nEND_METHOD\n"
    accessors = "".join(f"{word.upper()}\nEND_{word.upper()}\n" for word in member.accessors)
    return f"\n{member.declaration}\n{accessors}END_PROPERTY\n"


def _before_end(site: Site, text: str) -> Edit:
    """Put text before the END_FUNCTION_BLOCK of the block."""
    node = next((item for item in reversed(site.path) if isinstance(item, ast.Pou)), None)
    span = node.span if node is not None else site.span
    column = site.lines[span.end_line][: span.end_column].upper().rfind("END_FUNCTION_BLOCK")
    if column > 0 and site.lines[span.end_line][:column].strip():
        return site.insert(span.end_line, column, f"\n{text}")
    return site.before_line(span.end_line, text)
