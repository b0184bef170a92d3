"""What the fields of nodes hold is declared with the fields."""

from dataclasses import fields

import pytest

from tappet.lang import ast
from tappet.lang.analysis import analyse
from tappet.lang.analysis.generic import copied
from tappet.lang.ast.fields import resolved_fields, source_fields, tree_fields
from tappet.lang.parser import parse
from tappet.lang.source import Source
from tappet.lang.walk import same

NODES = [kind for kind in vars(ast).values() if isinstance(kind, type) and issubclass(kind, ast.Node)]
TEXT = """FUNCTION_BLOCK FB EXTENDS Base IMPLEMENTS Itf
VAR a : ARRAY[1..3] OF INT := [1, 2(7)]; t : STRING(10) := 'x'; b : BOOL; END_VAR
IF b AND a[2] > 1 THEN a[1] := ADD(a[2], 3) + SEL(b, 1, 2); b.0 := TRUE; END_IF
FOR a[1] := 1 TO 3 DO t := CONCAT(t, 'y'); END_FOR
END_FUNCTION_BLOCK
"""


@pytest.mark.parametrize("kind", NODES, ids=lambda kind: kind.__name__)
def test_every_field_has_one_role(kind: type[ast.Node]) -> None:
    names = {item.name for item in fields(kind)}
    assert set(source_fields(kind)) | set(tree_fields(kind)) | resolved_fields(kind) <= names
    assert not set(source_fields(kind)) & resolved_fields(kind)
    for name in ("type", "symbol", "constant", "is_constant", "parameter", "operand_type"):
        assert name not in source_fields(kind)
    assert not any(name.endswith(("span", "spans")) for name in source_fields(kind))


def test_a_copy_is_as_the_parser_made_it() -> None:
    source = Source("FB", TEXT)
    unit, again = parse(source).unit, parse(source).unit
    analyse([unit])
    copy = copied(unit.declarations[0])
    fresh = again.declarations[0]
    assert isinstance(copy, ast.Pou)
    assert isinstance(fresh, ast.Pou)
    assert repr(copy.body) == repr(fresh.body) != repr(unit.declarations[0].body)  # type: ignore[attr-defined]
    assert repr(copy.blocks) == repr(fresh.blocks)


def test_trees_are_the_same_whatever_analysis_has_filled_in() -> None:
    source = Source("FB", TEXT)
    unit, again = parse(source).unit, parse(source).unit
    analyse([unit])
    one, other = unit.declarations[0], again.declarations[0]
    assert isinstance(one, ast.Pou)
    assert isinstance(other, ast.Pou)
    assert all(map(same, one.body, other.body))
    assert not same(one.body[0], other.body[1])
