"""Names: LDEC-05..LDEC-10, CON-02."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tappet.iec.words import RESERVED
from tappet.project.errors import InvalidNameError
from tappet.project.naming import check_free_name, check_identifier, name_key, unique_name


@pytest.mark.parametrize("name", ["PLC_PRG", "_x", "a1", "LD", "S", "A_BCD", "FB_Motor"])
def test_identifiers(name: str) -> None:
    check_identifier(name)


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("", "no valid identifier"),
        ("1a", "not beginning with a digit"),
        ("a b", "no valid identifier"),
        ("a.b", "no valid identifier"),
        ("Größe", "no valid identifier"),
        ("a__b", "consecutive underscores"),
        ("if", "keyword"),
        ("Program", "keyword"),
        ("x" * 201, "longer than 200"),
    ],
)
def test_wrong_identifiers(name: str, reason: str) -> None:
    with pytest.raises(InvalidNameError, match=reason):
        check_identifier(name)


@pytest.mark.parametrize("name", ["Tappet Soft PLC", "电机 1", "Motors (left)", "50 %", "CON", "a:b"])
def test_free_names(name: str) -> None:
    check_free_name(name)


@pytest.mark.parametrize("name", ["", " a", "a/b", "a\\b", "a.b", "a\tb", "a\u200bb", "e\u0301", "x" * 201])
def test_wrong_free_names(name: str) -> None:
    with pytest.raises(InvalidNameError):
        check_free_name(name)


def test_names_are_compared_without_case() -> None:
    assert name_key("Motor") == name_key("MOTOR")
    assert name_key("straße") == name_key("STRASSE")
    assert name_key("Motor") != name_key("Motor1")


def test_unique_names_count_on() -> None:
    assert unique_name("Motor", []) == "Motor"
    assert unique_name("Motor", ["MOTOR"]) == "Motor_1"
    assert unique_name("Motor_1", ["Motor", "Motor_1", "motor_2"]) == "Motor_3"


@given(
    st.sampled_from(sorted(RESERVED)) | st.from_regex(r"[A-Za-z_][A-Za-z0-9_]{0,210}", fullmatch=True),
    st.data(),
)
def test_unique_name_is_free(name: str, data: st.DataObject) -> None:
    taken = [name, *data.draw(st.lists(st.sampled_from([name.upper(), f"{name}_1", f"{name}_2"])))]
    found = unique_name(name, taken)
    assert name_key(found) not in {name_key(other) for other in taken}
    assert len(found) <= 200
