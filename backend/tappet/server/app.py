"""The ASGI application: every part put together."""

from __future__ import annotations

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager

from fastapi import APIRouter, FastAPI
from fastapi.routing import APIRoute
from starlette.concurrency import run_in_threadpool
from starlette.middleware import Middleware

from tappet import __version__
from tappet.runtime.client import RuntimeClient
from tappet.server import (
    openapi,
    problems,
    routes_auth,
    routes_build,
    routes_docs,
    routes_events,
    routes_exchange,
    routes_flight,
    routes_health,
    routes_libraries,
    routes_lsp,
    routes_metrics,
    routes_objects,
    routes_online,
    routes_projects,
    routes_runtimes,
    routes_scenes,
    routes_settings,
    routes_static_analysis,
    routes_tests,
    routes_users,
    routes_values,
    routes_views,
)
from tappet.server.guard import RequestGuard
from tappet.server.plc_client import Connect
from tappet.server.services import open_services
from tappet.server.settings import ServerSettings
from tappet.server.static import FrontEnd, find_static

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
    routes_online.router,
    routes_build.router,
    routes_static_analysis.router,
    routes_tests.router,
    routes_libraries.router,
    routes_lsp.router,
    routes_projects.router,
    routes_exchange.router,
    routes_objects.router,
    routes_scenes.router,
    routes_events.router,
)
"""One router per resource, all below `API`."""


def _operation_id(route: APIRoute) -> str:
    """Names of operations in the OpenAPI document are those of the Python functions: `list_users`."""
    return route.name


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
        generate_unique_id_function=_operation_id,
        middleware=[Middleware(RequestGuard, settings=settings)],
        telemetry={"tracing": False, "metrics": False, "logs": False},
    )
    problems.install(app)
    api = APIRouter(prefix=API, responses=openapi.PROBLEM_RESPONSES, max_body_size=settings.max_body_bytes)
    for router in ROUTERS:
        api.include_router(router)
    app.include_router(api)
    app.include_router(routes_docs.router)
    app.include_router(routes_views.router)
    openapi.install(app)
    app.mount("/", FrontEnd(find_static(settings.static_dir)), name="front end")
    return app
