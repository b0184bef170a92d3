"""The table of places that the front end gets, and the answers that its look into it is held against."""

from hypothesis import given
from hypothesis import strategies as st
from placement_answers import ANSWERS, answers

from tappet.project.kind_registry import kinds
from tappet.project.object_kind import POUS_VIEW


def test_the_answers_are_up_to_date() -> None:
    assert ANSWERS.read_text(encoding="utf-8") == answers(), "run 'make generate'"


@given(
    st.sampled_from(list(kinds())),
    st.sampled_from([*kinds(), POUS_VIEW, "robot"]),
    st.sampled_from([None, "program", "function_block", "function", "gvl", "struct"]),
    st.booleans(),
)
def test_the_table_says_what_the_placement_of_a_kind_says(
    kind: str, parent: str, subkind: str | None, in_folder: bool
) -> None:
    rule = kinds()[kind].placement
    said = parent in rule.parents and (rule.in_folders or not in_folder)
    if subkind is not None and rule.parent_subkinds:
        said = said and subkind in rule.parent_subkinds
    assert rule.accepts(parent, subkind, in_folder) == said
