"""The WebSocket of the language server: one JSON-RPC message a text frame, relayed to the analysis."""

from __future__ import annotations

from functools import partial
from typing import Annotated

from fastapi import Query, WebSocket
from starlette.concurrency import run_in_threadpool

from tappet.project.store.records import UnknownProjectError
from tappet.server.analysis.project import PROJECT_GONE
from tappet.server.dependencies import ServicesDep, SessionDep, Viewer
from tappet.server.lsp import rpc
from tappet.server.routing import Router
from tappet.server.sockets import close_with_session, until_one_ends

router = Router(tags=["language"])

NOT_TEXT = 1003


@router.websocket("/lsp")
async def language_server(
    socket: WebSocket,
    who: Viewer,
    services: ServicesDep,
    session: SessionDep,
    project: Annotated[str, Query(description="Id of the project.")],
) -> None:
    """The Language Server Protocol on the objects of a project, documents `tappet:/PROJECT/OBJECT/PART`."""
    await run_in_threadpool(services.store.project, project)
    await socket.accept()
    client = services.analysis.attach(project)

    async def read() -> None:
        while True:
            message = await socket.receive()
            if message["type"] == "websocket.disconnect":
                return
            text = message.get("text")
            if text is None:
                await socket.close(NOT_TEXT, "messages are text")
                return
            try:
                await services.analysis.receive(project, client, text)
            except UnicodeEncodeError:  # half of a character: no message to the analysis can hold it
                client.outbox.put(rpc.failure(None, rpc.PARSE_ERROR, "This is no text"), "")
            except UnknownProjectError:
                await socket.close(PROJECT_GONE, "The project was deleted.")
                return

    async def write() -> None:
        while (text := await client.outbox.take()) is not None:
            await socket.send_text(text)
        code, reason = client.outbox.closed or (1000, "")
        await socket.close(code, reason)

    try:
        await until_one_ends(read, write, partial(close_with_session, socket, session))
    finally:
        services.analysis.detach(project, client)
