"""The debug adapter on a WebSocket: one message of the protocol a text frame, for a runtime of the server."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from functools import partial
from typing import Annotated

from fastapi import Query, WebSocket
from starlette.concurrency import run_in_threadpool

from tappet.project.model import Project
from tappet.server.audited import ActRecord
from tappet.server.auth.identity import Identity
from tappet.server.builds.packages import StoredPackage
from tappet.server.dap.debuggee import Debuggee, Refused
from tappet.server.dap.messages import Attach, Launch
from tappet.server.dap.session import DebugSession
from tappet.server.dependencies import Engineer, ServicesDep, SessionDep
from tappet.server.problems import Problem
from tappet.server.routing import Router
from tappet.server.runtimes.links import RuntimeLink
from tappet.server.services import Services
from tappet.server.sockets import close_with_session, until_one_ends

router = Router(tags=["debugger"])
NOT_TEXT = 1003


@router.websocket("/dap")
async def debug_adapter(
    socket: WebSocket,
    who: Engineer,
    services: ServicesDep,
    session: SessionDep,
    runtime: Annotated[str, Query(description="Id of the runtime.")],
) -> None:
    """The Debug Adapter Protocol on what a runtime runs; `attach` needs no arguments.

    Texts are those that were downloaded, `tappet:/PROJECT/OBJECT/PART`.
    """
    link = services.runtimes.get(runtime)
    await socket.accept()

    async def begin(wanted: Launch | Attach, _say: Callable[[str], Awaitable[None]]) -> Debuggee:
        if isinstance(wanted, Launch):
            raise Refused("A runtime of the server is attached to: send attach")
        return await _debuggee(services, link, who)

    debugging = DebugSession(socket.send_text, begin)

    async def read() -> None:
        while not debugging.ended.is_set():
            message = await socket.receive()
            if message["type"] == "websocket.disconnect":
                return
            text = message.get("text")
            if text is None:
                await socket.close(NOT_TEXT, "messages are text")
                return
            await debugging.receive(text)
        await socket.close()

    try:
        await until_one_ends(read, partial(close_with_session, socket, session))
    finally:
        await debugging.close()


async def _debuggee(services: Services, link: RuntimeLink, who: Identity) -> Debuggee:
    """What a runtime runs, with the texts that it was built of. Raises Refused."""
    # Most servers never debug by this way: they start without what it needs.
    from tappet.codegen.package import CodePackage
    from tappet.server.dap.connecting import library_text
    from tappet.server.dap.link_caller import LinkCaller
    from tappet.server.dap.program_files import ObjectDocuments
    from tappet.server.dap.runtime_debuggee import RuntimeDebuggee

    try:
        link.loaded_symbols()
    except Problem as problem:
        raise Refused(problem.detail) from problem
    code_id = (link.info.code_id if link.info is not None else None) or ""
    found = await run_in_threadpool(_downloaded, services, code_id)
    if found is None:
        raise Refused(
            f"This server does not have the texts of what runs in '{link.name}', so it cannot be "
            "debugged from here; download the application again."
        )
    stored, project = found
    names = {item.id: project.path_of(item.id) for item in project.walk()}
    head = f"tappet:/{stored.project_id}/"

    def text(reference: str) -> str | None:
        if not reference.startswith(head):
            return library_text(reference)
        object_id, _, part = reference.removeprefix(head).partition("/")
        value = getattr(project.get(object_id).data, part, None) if object_id in names else None
        return value if isinstance(value, str) else None

    async def load_variant() -> None:
        try:
            await services.debug.prepare(link)
        except Problem as problem:
            raise Refused(problem.detail) from problem

    caller = LinkCaller(link, lambda: ActRecord(services.database, services.audit_reserve, who))
    package = CodePackage.from_bytes(stored.data)
    documents = ObjectDocuments(stored.project_id, names)
    debuggee = RuntimeDebuggee(caller, package, load_variant, documents, text)

    async def end() -> None:
        caller.close()

    debuggee.at_end(end)
    return debuggee


def _downloaded(services: Services, code_id: str) -> tuple[StoredPackage, Project] | None:
    """The package with a code id and the project that it was built from."""
    packages = services.commissioning.packages
    stored, source = packages.find(code_id), packages.source(code_id)
    return None if stored is None or source is None else (stored, source[0])
