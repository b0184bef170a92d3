"""Who has a project open, and what changes in it: from the store to the events sockets.

The store signals a change in the thread that made it; here it goes to the event loop and from there to the
sockets of the project. A socket that cannot follow is closed: its page reconnects and reloads.
"""

from __future__ import annotations

import asyncio
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial
from itertools import count

from pydantic import BaseModel, ValidationError
from starlette.websockets import WebSocket

from tappet.project.store import Store
from tappet.project.store.records import ChangeEvent
from tappet.server import sockets
from tappet.server.events.presence import ProjectPresence
from tappet.server.events.shapes import ObjectChanged, OpenObject
from tappet.server.objects.replies import object_summary

LONGEST_QUEUE = 2000
"""Messages that may wait for one slow socket."""
TOO_SLOW = 4408
"""Close code for a socket that did not take its messages."""
NOT_UNDERSTOOD = 1003


@dataclass(eq=False, slots=True)
class _Member:
    """One socket that has a project open."""

    queue: asyncio.Queue[str] = field(default_factory=asyncio.Queue)
    overrun: asyncio.Event = field(default_factory=asyncio.Event)


class _Room:
    """The sockets of one project."""

    def __init__(self) -> None:
        self.members: dict[int, _Member] = {}
        self.presence = ProjectPresence(self._deliver)

    def _deliver(self, numbers: Iterable[int], message: BaseModel) -> None:
        _queue((self.members[number] for number in numbers), [message])


class ProjectEvents:
    """All events sockets of a server. Made in the event loop that serves them."""

    def __init__(self, store: Store) -> None:
        self._loop = asyncio.get_running_loop()
        self._rooms: dict[str, _Room] = {}
        self._numbers = count(1)
        self._stop = store.listen(self._stored)

    def close(self) -> None:
        """Hear no more of the store, and tell nobody."""
        self._stop()
        for room in self._rooms.values():
            room.presence.close()

    async def serve(
        self,
        socket: WebSocket,
        project_id: str,
        username: str,
        session: sockets.SessionWatch,
    ) -> None:
        """Serve one socket until it closes. Never raises for what the browser sends or how it leaves."""
        await socket.accept()
        room = self._rooms.setdefault(project_id, _Room())
        number, member = next(self._numbers), _Member()
        room.members[number] = member
        room.presence.enter(number, username)
        try:
            await sockets.until_one_ends(
                partial(_read, socket, room.presence, number),
                partial(_send, socket, member),
                partial(_close_overrun, socket, member),
                partial(sockets.close_with_session, socket, session),
            )
        finally:
            del room.members[number]
            room.presence.leave(number)
            if not room.members:
                room.presence.close()
                del self._rooms[project_id]

    def _stored(self, event: ChangeEvent) -> None:
        """Called by the store in any thread."""
        with suppress(RuntimeError):  # the loop is closed: nobody listens any more
            self._loop.call_soon_threadsafe(self._publish_change, event)

    def _publish_change(self, event: ChangeEvent) -> None:
        room = self._rooms.get(event.project_id)
        if room is None:
            return
        messages = (
            ObjectChanged(change=change.action, object=object_summary(change.summary), author=event.author)
            for change in event.objects
        )
        _queue(room.members.values(), messages)


async def _read(socket: WebSocket, presence: ProjectPresence, number: int) -> None:
    while True:
        try:
            message = OpenObject.model_validate_json(await socket.receive_text())
        except (ValidationError, KeyError):
            await socket.close(NOT_UNDERSTOOD, 'send {"op": "open", "object_id": ...}')
            return
        presence.look(number, message.object_id)


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
