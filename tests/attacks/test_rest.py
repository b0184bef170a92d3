"""Requests of every role by the OpenAPI document, against a server with an application that runs."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from live_team import ROLES, Team, team
from rest_attack import NOBODY, attack

ALL = (NOBODY, *ROLES)


@pytest.fixture(scope="module")
def attacked(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Team]:
    with team(tmp_path_factory.mktemp("attacked")) as found:
        yield found


@pytest.mark.parametrize("role", ALL)
def test_no_request_by_the_document_is_a_find(attacked: Team, role: str) -> None:
    result = attack(attacked, role, seed=1, examples=2, phases=("fuzzing",))
    assert not result.finds, result.report()
    attacked.check_running()
