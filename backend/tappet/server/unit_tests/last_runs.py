"""The last test run of each application, kept for who opens the project later."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from datetime import UTC, datetime

from sqlalchemy import ColumnElement, Connection, delete, insert, select

from tappet.runtime.unit_tests.order import order
from tappet.server.tables import test_runs
from tappet.server.unit_tests.service import TestedApplication
from tappet.server.unit_tests.shapes import TestReport, TestResult, TestRun


def digest(tested: TestedApplication) -> str:
    """Changes with everything that a test run takes of a project."""
    application = tested.application
    content = order(application.name, application.sources, application.tasks, application.libraries)
    found = hashlib.blake2b(content, digest_size=32)
    for test in tested.recordings:
        found.update(f"\n{test.name}\n{test.same_fault}\n{test.text}".encode())
    return found.hexdigest()


def keep(
    db: Connection,
    tested: TestedApplication,
    revision: int,
    username: str,
    report: TestReport,
    seconds: float,
    only: Sequence[str] = (),
) -> None:
    """Replaces the last run; with `only`, its tests that were not chosen keep their results."""
    before = read(db, tested) if only else None
    if before is not None:
        report = with_others(before.report, report, only)
    db.execute(delete(test_runs).where(_of(tested)))
    row = {
        "project_id": tested.application.project_id,
        "application_id": tested.application.application_id,
        "at": datetime.now(UTC),
        "username": username,
        "revision": revision,
        "digest": digest(tested),
        "seconds": seconds,
        "report": report.model_dump(mode="json"),
    }
    db.execute(insert(test_runs).values(**row))


def read(db: Connection, tested: TestedApplication) -> TestRun | None:
    """The last run of the application, which is as it is stored now."""
    row = db.execute(select(test_runs).where(_of(tested))).mappings().one_or_none()
    if row is None:
        return None
    return TestRun(
        at=row["at"],
        username=row["username"],
        revision=row["revision"],
        seconds=row["seconds"],
        outdated=row["digest"] != digest(tested),
        report=TestReport.model_validate(row["report"]),
    )


def _of(tested: TestedApplication) -> ColumnElement[bool]:
    c, application = test_runs.c, tested.application
    return (c.project_id == application.project_id) & (c.application_id == application.application_id)


def with_others(before: TestReport, now: TestReport, ran: Sequence[str]) -> TestReport:
    """A run of some tests, with the others as they were before. A run that came to no test is as it is."""
    if now.diagnostics or not now.suites:
        return now
    chosen = set(ran)
    known = {_name(suite.name, test): test for suite in before.suites for test in suite.tests}

    def result(suite: str, test: TestResult) -> TestResult:
        name = _name(suite, test)
        return test if name in chosen else known.get(name, test)

    suites = [
        suite.model_copy(update={"tests": [result(suite.name, test) for test in suite.tests]})
        for suite in now.suites
    ]
    outcomes = [test.outcome for suite in suites for test in suite.tests]
    count = {key: outcomes.count(key) for key in ("passed", "failed", "error", "skipped")}
    good = not count["failed"] and not count["error"] and not any(suite.failures for suite in suites)
    update = {"suites": suites, "ok": good and now.problem is None, "total": len(outcomes), **count}
    return now.model_copy(update=update)


def _name(suite: str, test: TestResult) -> str:
    return f"{suite}.{test.name}"
