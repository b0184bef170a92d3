"""Unit tests of an application."""

from __future__ import annotations

from tappet.server.dependencies import CommissioningDep, Engineer, ServicesDep
from tappet.server.problems import Problem
from tappet.server.routing import Router
from tappet.server.unit_tests.shapes import TestOrder, TestReport

router = Router(prefix="/projects/{project_id}/applications/{application_id}/tests", tags=["tests"])


@router.post("")
async def run_tests(
    project_id: str,
    application_id: str,
    body: TestOrder,
    who: Engineer,
    commissioning: CommissioningDep,
    services: ServicesDep,
) -> TestReport:
    """Run the test suites of the application as it is stored, on simulated time, beside the server."""
    application = await commissioning.application(project_id, application_id)
    return await services.test_runs.run(application, body.filter, body.only)


@router.delete("", status_code=204)
async def cancel_tests(project_id: str, application_id: str, who: Engineer, services: ServicesDep) -> None:
    """End the running tests; who waits for them gets what is known."""
    if not services.test_runs.cancel(project_id, application_id):
        raise Problem(404, "not-found", "No tests of this application are running.")
