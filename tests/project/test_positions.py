"""Sibling positions: the wanted order comes out, and as few rows as possible change."""

from hypothesis import given
from hypothesis import strategies as st

from tappet.project.store.positions import GAP, new_positions


def test_appending_and_moving_touch_one() -> None:
    current = {"a": GAP, "b": 2 * GAP, "c": 3 * GAP}
    assert new_positions(["a", "b", "c"], current) == {}
    assert new_positions(["a", "b", "c", "d"], current) == {"d": 4 * GAP}
    assert new_positions(["c", "a", "b"], current) == {"c": 0}
    assert new_positions(["a", "c", "b"], current).keys() in ({"b"}, {"c"})


def test_a_full_gap_is_renumbered() -> None:
    assert new_positions(["a", "x", "b"], {"a": 7, "b": 8}) == {"a": GAP, "x": 2 * GAP, "b": 3 * GAP}


@given(st.lists(st.integers(0, 30), unique=True, max_size=12), st.data())
def test_any_order_comes_out(places: list[int], data: st.DataObject) -> None:
    current = {f"o{i}": place for i, place in enumerate(places)}
    kept = data.draw(st.lists(st.sampled_from(sorted(current)), unique=True)) if current else []
    order = data.draw(st.permutations([*kept, *data.draw(st.sets(st.sampled_from("xyz")))]))
    changed = new_positions(order, current)
    after = {key: current.get(key) for key in order} | changed
    assert None not in after.values()
    assert sorted(order, key=lambda key: after[key] or 0) == list(order)
    assert len(set(after.values())) == len(order)
    if list(order) == sorted(order, key=lambda key: current.get(key, 0)) and set(order) <= current.keys():
        assert changed == {}
