"""Requests of every role by the OpenAPI document, against a server with an application that runs."""

from __future__ import annotations

import os
import secrets
from collections.abc import Iterator

import pytest
from live_team import ROLES, Team, team
from rest_attack import NOBODY, attack

ALL = (NOBODY, *ROLES)
SERVED = {NOBODY: 2, "viewer": 40, "operator": 45, "engineer": 65, "admin": 70}
"""So many operations must have been served at least once: an attack that is always refused shows nothing."""


@pytest.fixture(scope="module")
def attacked(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Team]:
    with team(tmp_path_factory.mktemp("attacked")) as found:
        yield found


@pytest.mark.parametrize("role", [NOBODY, "engineer"])
def test_no_request_by_the_document_is_a_find(attacked: Team, role: str) -> None:
    result = attack(attacked, role, seed=1, examples=1, phases=("fuzzing",))
    assert not result.finds, result.report()
    assert len(result.served) >= SERVED[role]
    attacked.check_running()


@pytest.mark.slow
@pytest.mark.parametrize("role", ALL)
def test_nor_is_one_of_many(attacked: Team, role: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Another seed each time, printed; TAPPET_SEED repeats one."""
    seed = int(os.environ.get("TAPPET_SEED") or secrets.randbelow(1 << 32))
    result = attack(attacked, role, seed=seed, examples=25)
    with capsys.disabled():
        print(f"\n{role}, TAPPET_SEED={seed}: {result.answers.total()} requests", dict(result.answers))
    assert not result.finds, result.report()
    assert len(result.served) >= SERVED[role]
    attacked.check_running()
