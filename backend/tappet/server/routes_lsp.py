"""The WebSocket of the language server: one JSON-RPC message a text frame."""

from __future__ import annotations

import asyncio
from contextlib import suppress
from functools import partial
from typing import Annotated

import anyio
from fastapi import APIRouter, Query, WebSocket
from starlette.concurrency import run_in_threadpool

from tappet.project.store.records import ChangeEvent
from tappet.server.dependencies import ServicesDep, SessionCheck, Viewer
from tappet.server.lsp.library_names import libraries_with
from tappet.server.lsp.project_programs import ProjectPrograms
from tappet.server.lsp.session import LanguageSession
from tappet.server.sockets import close_with_session, until_one_ends

router = APIRouter(tags=["language"])

NOT_TEXT = 1003


@router.websocket("/lsp")
async def language_server(
    socket: WebSocket,
    who: Viewer,
    services: ServicesDep,
    still_allowed: SessionCheck,
    project: Annotated[str, Query(description="Id of the project.")],
) -> None:
    """The Language Server Protocol on the objects of a project, documents `tappet:/PROJECT/OBJECT/PART`."""
    await run_in_threadpool(services.store.project, project)
    programs = ProjectPrograms(project, lambda: services.store.load(project))
    await socket.accept()
    loop = asyncio.get_running_loop()
    session = LanguageSession(programs, socket.send_text, offering=libraries_with)

    def changed(event: ChangeEvent) -> None:  # in the thread that has stored it
        if event.project_id == project:
            programs.changed()
            with suppress(RuntimeError):  # the loop has ended
                loop.call_soon_threadsafe(session.stored_texts_changed)

    async def read() -> None:
        while not session.exit.is_set():
            message = await socket.receive()
            if message["type"] == "websocket.disconnect":
                return
            text = message.get("text")
            if text is None:
                await socket.close(NOT_TEXT, "messages are text")
                return
            await session.receive(text)

    stop = services.store.listen(changed)
    try:
        await until_one_ends(read, partial(close_with_session, socket, still_allowed))
    finally:
        stop()
        with anyio.CancelScope(shield=True):
            await session.close()
