"""Unit tests of an application."""

from __future__ import annotations

import time

from starlette.concurrency import run_in_threadpool

from tappet.server.dependencies import DatabaseDep, Engineer, ServicesDep, StoreDep, Viewer
from tappet.server.problems import Problem
from tappet.server.routing import Router
from tappet.server.spoken import LanguageDep, in_language
from tappet.server.unit_tests import last_runs
from tappet.server.unit_tests.service import TestedApplication
from tappet.server.unit_tests.shapes import TestOrder, TestReport, TestRun

router = Router(prefix="/projects/{project_id}/applications/{application_id}/tests", tags=["tests"])


@router.get("")
def last_run(
    project_id: str,
    application_id: str,
    who: Viewer,
    store: StoreDep,
    database: DatabaseDep,
    language: LanguageDep,
) -> TestRun | None:
    """The last run of the tests of the application, whoever started it; null before the first one."""
    tested = TestedApplication.of(project_id, store.load(project_id), application_id)
    return in_language(database.read(lambda db: last_runs.read(db, tested)), language)


@router.post("")
async def run_tests(
    project_id: str,
    application_id: str,
    body: TestOrder,
    who: Engineer,
    services: ServicesDep,
    language: LanguageDep,
) -> TestReport:
    """Run the test suites of the application as it is stored, on simulated time, beside the server.

    Then the recordings of the flight recorder that are tests of it are replayed on its present program.

    The report becomes that of the last run; with `only`, the other tests keep their results there.
    """
    begun = time.perf_counter()
    info, project = await run_in_threadpool(services.store.snapshot, project_id)
    tested = await run_in_threadpool(TestedApplication.of, project_id, project, application_id)
    report = await services.test_runs.run(tested, body.filter, body.only)
    seconds = time.perf_counter() - begun
    await services.database.write_async(
        lambda db: last_runs.keep(db, tested, info.revision, who.username, report, seconds, body.only)
    )
    return in_language(report, language)


@router.delete("", status_code=204)
async def cancel_tests(project_id: str, application_id: str, who: Engineer, services: ServicesDep) -> None:
    """End the running tests; who waits for them gets what is known."""
    if not services.test_runs.cancel(project_id, application_id):
        raise Problem(404, "not-found", "No tests of this application are running.")
