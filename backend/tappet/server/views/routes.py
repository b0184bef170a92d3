"""Pages and sockets of 3D views; not below `/api/v1`, because a browser shows them in a frame."""

from __future__ import annotations

from fastapi import Request, Response, WebSocket
from starlette.responses import RedirectResponse

from tappet.server.dependencies import ServicesDep, SessionDep, Viewer
from tappet.server.routing import Router
from tappet.server.views.service import VIEW_POLICY

router = Router(prefix="/views", include_in_schema=False)


@router.get("/{view_id}")
async def view_without_slash(view_id: str, who: Viewer) -> RedirectResponse:
    """Relative names of the page need the slash."""
    return RedirectResponse(f"/views/{view_id}/", 308)


@router.get("/{view_id}/{path:path}")
async def view_page(
    view_id: str, path: str, who: Viewer, request: Request, services: ServicesDep
) -> Response:
    """A file of a view's page."""
    answer = await services.views.fetch(view_id, path, request.headers.get("accept-encoding", "identity"))
    headers = answer.headers | {"Content-Security-Policy": VIEW_POLICY, "Cache-Control": "no-cache"}
    return Response(answer.content, answer.status, headers)


@router.websocket("/{view_id}")
@router.websocket("/{view_id}/")
async def view_socket(
    view_id: str, who: Viewer, socket: WebSocket, services: ServicesDep, session: SessionDep
) -> None:
    """The scene of a view and what its user does in it."""
    await services.views.connect(view_id, socket, session)
