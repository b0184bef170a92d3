"""Who has a project open, and what changes in it: from the store to the events sockets.

The store signals a change in the thread that made it; here it goes to the event loop and from there to the
sockets of the project. A socket that cannot follow is closed: its page reconnects and reloads.
"""

from __future__ import annotations

import asyncio
from collections import defaultdict
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass
from functools import partial

from pydantic import BaseModel, ValidationError
from starlette.websockets import WebSocket

from tappet.project.store import Store
from tappet.project.store.records import ChangeEvent
from tappet.server import sockets
from tappet.server.events.shapes import ObjectChanged, OpenObject, Presence, PresentUser
from tappet.server.objects.replies import object_summary

LONGEST_QUEUE = 2000
"""Messages that may wait for one slow socket."""
TOO_SLOW = 4408
"""Close code for a socket that did not take its messages."""
NOT_UNDERSTOOD = 1003


@dataclass(eq=False, slots=True)
class _Member:
    """One socket that has a project open."""

    username: str
    object_id: str | None
    queue: asyncio.Queue[str]
    overrun: asyncio.Event


class ProjectEvents:
    """All events sockets of a server. Made in the event loop that serves them."""

    def __init__(self, store: Store) -> None:
        self._loop = asyncio.get_running_loop()
        self._members: dict[str, list[_Member]] = defaultdict(list)
        self._stop = store.listen(self._stored)

    def close(self) -> None:
        """Hear no more of the store."""
        self._stop()

    async def serve(
        self,
        socket: WebSocket,
        project_id: str,
        username: str,
        session: sockets.SessionWatch,
    ) -> None:
        """Serve one socket until it closes. Never raises for what the browser sends or how it leaves."""
        await socket.accept()
        member = _Member(username, None, asyncio.Queue(), asyncio.Event())
        self._members[project_id].append(member)
        self._publish_presence(project_id)
        try:
            await sockets.until_one_ends(
                partial(self._read, socket, project_id, member),
                partial(_send, socket, member),
                partial(_close_overrun, socket, member),
                partial(sockets.close_with_session, socket, session),
            )
        finally:
            self._members[project_id].remove(member)
            if not self._members[project_id]:
                del self._members[project_id]
            self._publish_presence(project_id)

    async def _read(self, socket: WebSocket, project_id: str, member: _Member) -> None:
        while True:
            try:
                message = OpenObject.model_validate_json(await socket.receive_text())
            except (ValidationError, KeyError):
                await socket.close(NOT_UNDERSTOOD, 'send {"op": "open", "object_id": ...}')
                return
            if message.object_id != member.object_id:
                member.object_id = message.object_id
                self._publish_presence(project_id)

    def _stored(self, event: ChangeEvent) -> None:
        """Called by the store in any thread."""
        with suppress(RuntimeError):  # the loop is closed: nobody listens any more
            self._loop.call_soon_threadsafe(self._publish_change, event)

    def _publish_change(self, event: ChangeEvent) -> None:
        members = self._members.get(event.project_id, ())
        if not members:
            return
        messages = (
            ObjectChanged(change=change.action, object=object_summary(change.summary), author=event.author)
            for change in event.objects
        )
        _queue(members, messages)

    def _publish_presence(self, project_id: str) -> None:
        members = self._members.get(project_id, ())
        users = [PresentUser(username=member.username, object_id=member.object_id) for member in members]
        _queue(members, [Presence(users=users)])


def _queue(members: Iterable[_Member], messages: Iterable[BaseModel]) -> None:
    texts = [message.model_dump_json() for message in messages]
    for member in members:
        if member.queue.qsize() + len(texts) > LONGEST_QUEUE:
            member.overrun.set()
            continue
        for text in texts:
            member.queue.put_nowait(text)


async def _send(socket: WebSocket, member: _Member) -> None:
    while True:
        await socket.send_text(await member.queue.get())


async def _close_overrun(socket: WebSocket, member: _Member) -> None:
    """Close the socket when it cannot follow."""
    await member.overrun.wait()
    await socket.close(TOO_SLOW, "too many changes to follow; read the project again")
