"""The ASGI application: every part put together."""

from __future__ import annotations

from collections.abc import AsyncIterator, Sequence
from contextlib import asynccontextmanager
from functools import cache
from typing import Any

from fastapi import APIRouter, FastAPI
from fastapi.routing import APIRoute
from starlette.concurrency import run_in_threadpool
from starlette.middleware import Middleware
from starlette.routing import BaseRoute

from tappet import __version__
from tappet.runtime.client import RuntimeClient
from tappet.runtime.operations import registry
from tappet.runtime.operations.declaration import WireOperation
from tappet.server import openapi, problems
from tappet.server.auth import routes as routes_auth
from tappet.server.builds import routes as routes_build
from tappet.server.cams import routes as routes_cams
from tappet.server.cams import running_routes as routes_running_cams
from tappet.server.cnc import routes as routes_cnc
from tappet.server.comparisons import routes as routes_comparisons
from tappet.server.dap import routes as routes_dap
from tappet.server.docs import routes as routes_docs
from tappet.server.documentation import routes as routes_documentation
from tappet.server.events import routes as routes_events
from tappet.server.exchange import routes as routes_exchange
from tappet.server.flight import recording_routes as routes_flight_recordings
from tappet.server.flight import routes as routes_flight
from tappet.server.guard import RequestGuard
from tappet.server.health import routes as routes_health
from tappet.server.help import routes as routes_help
from tappet.server.history import routes as routes_history
from tappet.server.libraries import routes as routes_libraries
from tappet.server.lsp import routes as routes_lsp
from tappet.server.metrics import routes as routes_metrics
from tappet.server.objects import routes as routes_objects
from tappet.server.online import routes as routes_online
from tappet.server.paths import routes as routes_paths
from tappet.server.persistent import routes as routes_persistent
from tappet.server.personal_settings import routes as routes_settings
from tappet.server.projects import routes as routes_projects
from tappet.server.recipes import controller_routes as routes_recipe_files
from tappet.server.recipes import routes as routes_recipes
from tappet.server.runtimes import operations
from tappet.server.runtimes import routes as routes_runtimes
from tappet.server.runtimes.plc_client import Connect
from tappet.server.scenes import routes as routes_scenes
from tappet.server.search import routes as routes_search
from tappet.server.services import open_services
from tappet.server.settings import ServerSettings
from tappet.server.source import routes as routes_source
from tappet.server.static import FrontEnd, find_static
from tappet.server.static_analysis import routes as routes_static_analysis
from tappet.server.traces import recording_routes as routes_recordings
from tappet.server.traces import routes as routes_traces
from tappet.server.tuning import routes as routes_tuning
from tappet.server.unit_tests import routes as routes_tests
from tappet.server.users import routes as routes_users
from tappet.server.values import routes as routes_values
from tappet.server.versions import routes as routes_versions
from tappet.server.views import routes as routes_views

API = "/api/v1"
ROUTERS: tuple[APIRouter, ...] = (
    routes_health.router,
    routes_auth.router,
    routes_users.router,
    routes_settings.router,
    routes_metrics.router,
    routes_runtimes.router,
    routes_values.router,
    routes_flight.router,
    routes_flight_recordings.router,
    routes_online.router,
    routes_build.router,
    routes_source.router,
    routes_build.all_router,
    routes_versions.router,
    routes_static_analysis.router,
    routes_tests.router,
    routes_libraries.router,
    routes_help.router,
    routes_dap.router,
    routes_lsp.router,
    routes_projects.router,
    routes_exchange.router,
    routes_documentation.router,
    routes_objects.router,
    routes_search.router,
    routes_history.router,
    routes_comparisons.router,
    routes_scenes.router,
    routes_paths.router,
    routes_persistent.router,
    routes_recipes.router,
    routes_recipe_files.router,
    routes_cams.router,
    routes_running_cams.router,
    routes_cnc.router,
    routes_tuning.router,
    routes_traces.router,
    routes_traces.settings_router,
    routes_recordings.router,
    routes_events.router,
)
"""One router per resource, all below `API`; the routes of wire operations come behind them."""


def _operation_id(route: APIRoute) -> str:
    """Names of operations in the OpenAPI document are those of the Python functions: `list_users`."""
    return route.name


@cache
def _routes(max_body_bytes: int, kinds: tuple[type[WireOperation[Any]], ...]) -> Sequence[BaseRoute]:
    """All resources and wire operations: the same for every application, and each takes a millisecond."""
    api = APIRouter(prefix=API, responses=openapi.PROBLEM_RESPONSES, max_body_size=max_body_bytes)
    for router in (*ROUTERS, operations.router(kinds)):
        api.include_router(router)
    root = APIRouter(generate_unique_id_function=_operation_id)
    for router in (api, routes_docs.router, routes_views.router):
        root.include_router(router)
    return root.routes


def create_app(settings: ServerSettings, connect: Connect = RuntimeClient.connect) -> FastAPI:
    """The application for `settings`. Nothing is opened before its lifespan starts."""

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        app.state.services = services = await run_in_threadpool(open_services, settings, connect)
        await services.start()
        try:
            yield
        finally:
            await services.close()

    app = FastAPI(
        title="Tappet",
        version=__version__,
        summary="Browser-based PLC engineering: the same operations as the workbench.",
        lifespan=lifespan,
        openapi_url=None,
        docs_url=None,
        redoc_url=None,
        middleware=[Middleware(RequestGuard, settings=settings)],
        telemetry={"tracing": False, "metrics": False, "logs": False},
    )
    problems.install(app)
    app.router.routes += _routes(settings.max_body_bytes, tuple(registry.known().values()))
    openapi.install(app)
    app.mount("/", FrontEnd(find_static(settings.static_dir)), name="front end")
    return app
