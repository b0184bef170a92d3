"""The one analysis of a project that all its sessions share, and when its messages are published.

Contract: every session attached to a `ProjectAnalysis` sees the same programs, made of the stored texts and
the newest unsaved text of each document (`shared_texts`); all work on them is done in one thread, in turns
of one request or edit a session. Cost: one workspace however many sessions there are, besides the texts
that each shows and the messages published to it. Reason: the trees of a project and its libraries are tens of
megabytes and seconds of work, the same for everybody who has the project open.
"""

from __future__ import annotations

import asyncio
import contextlib
import gc
import logging
from collections.abc import Callable
from concurrent.futures import Executor, ThreadPoolExecutor
from typing import Any, Final, Protocol

from tappet.lang.deep_trees import deep_recursion
from tappet.lang.services.documents import Programs
from tappet.lang.services.reports import reports
from tappet.lang.services.results import Report
from tappet.lang.services.workspace import Snapshot, Workspace
from tappet.server.lsp.protocol.synchronization import PublishDiagnosticsParams
from tappet.server.lsp.publication import Publication, Published
from tappet.server.lsp.reached_libraries import ReachedLibraries
from tappet.server.lsp.rpc import Endpoint
from tappet.server.lsp.shared_texts import SharedTexts, Stored, nothing_stored

DEBOUNCE_S: Final = 0.3
"""Pause in the typing after which messages are worked out again."""
OPENING_S: Final = 0.05
"""Pause after documents were opened without being edited: a client opens several one after the other."""
IDLE_S: Final = 2.0
"""Pause without edits after which garbage is looked for, which takes longer than a check."""
UNTIDY: Final = 3
"""So many whole analyses leave garbage at most, also when edits never pause."""
SLICE_S: Final = 0.03
"""Requests and edits wait at most so long for a check that runs after the messages of the edited text."""

log = logging.getLogger(__name__)


class Subscriber(Protocol):
    """A session as the analysis needs it."""

    endpoint: Endpoint
    publication: Publication

    @property
    def is_initialized(self) -> bool:
        """Whether the client wants messages."""


Message = tuple[Subscriber, PublishDiagnosticsParams]
"""Params of published messages, and who gets them."""


class ProjectAnalysis:
    """Made in the event loop that serves it; `close` ends it."""

    def __init__(
        self,
        programs: Programs,
        *,
        stored: Stored = nothing_stored,
        debounce_s: float = DEBOUNCE_S,
        thread: Executor | None = None,
    ) -> None:
        """`thread` does one piece of work after the other; this ends it, too."""
        self.workspace = Workspace(programs, ReachedLibraries())
        self.texts = SharedTexts(stored)
        self.thread = thread or ThreadPoolExecutor(max_workers=1, thread_name_prefix="analysis")
        """Does everything that reads or changes the workspace."""
        self.loop = asyncio.get_running_loop()
        self._debounce_s = debounce_s
        self._sessions: list[Subscriber] = []
        self._edited_since: set[str] = set()
        """Documents edited since messages were published last: theirs come first."""
        self._left = False
        """Whether messages of other documents are still to be worked out."""
        self._timer: asyncio.TimerHandle | None = None
        self._publishing: asyncio.Task[None] | None = None
        self._again = False
        self._tidying: asyncio.TimerHandle | None = None
        self._tidied = 0
        """Whole analyses of the workspace whose garbage is gone."""

    # -- sessions and texts

    def attach(self, session: Subscriber) -> None:
        """A session works on the project from now on."""
        self._sessions.append(session)

    def detach(self, session: Subscriber, documents: list[str]) -> None:
        """A session has ended; its unsaved texts count no longer. Call in the event loop."""
        with contextlib.suppress(ValueError):
            self._sessions.remove(session)

        def drop() -> None:
            for document in documents:
                self.drop(session, document)

        if documents:
            with contextlib.suppress(RuntimeError):  # the thread has ended with the project
                self.thread.submit(drop)

    def put(self, session: Subscriber, document: str, text: str, *, edited: bool) -> None:
        """A session shows this text of a document. Call in the thread."""
        self.texts.put(session, document, text)
        changed = self._take(document)
        self.schedule_from_thread(edited or changed)

    def drop(self, session: Subscriber, document: str) -> None:
        """A session shows a document no longer. Call in the thread."""
        self.texts.drop(session, document)
        self.schedule_from_thread(self._take(document))

    def _take(self, document: str) -> bool:
        """Give the workspace the text that counts; whether it is another one."""
        before, taken = self.workspace.unsaved(document), self.texts.taken(document)
        if taken == before:
            return False
        self._edited_since.add(document)
        if taken is None:
            self.workspace.close(document)
        else:
            self.workspace.open(document, taken)
        return True

    def refresh(self) -> None:
        """What is stored has changed. Call in the thread."""
        self.workspace.refresh()
        if self._sessions:
            self.schedule_from_thread(True)

    def stored_texts_changed(self) -> None:
        """Somebody else has changed what is stored: the next request sees it, also that of a session to
        come. Call in the event loop."""
        self.thread.submit(self.refresh)

    async def close(self) -> None:
        """End the analysis, whatever it does."""
        for timer in (self._timer, self._tidying):
            if timer is not None:
                timer.cancel()
        if self._publishing is not None:
            self._publishing.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await self._publishing
        self.thread.shutdown(wait=False, cancel_futures=True)

    # -- messages

    def schedule_from_thread(self, edited: bool) -> None:
        """As `schedule`, from the thread."""
        with contextlib.suppress(RuntimeError):  # the loop has ended
            self.loop.call_soon_threadsafe(self.schedule, edited)

    def schedule(self, edited: bool) -> None:
        """Publish messages when the typing pauses, or soon when nothing was edited."""
        if self._timer is not None:
            if not edited:
                return
            self._timer.cancel()
        if self._tidying is not None:
            self._tidying.cancel()
        pause = self._debounce_s if edited else min(self._debounce_s, OPENING_S)
        self._timer = self.loop.call_later(pause, self._publish_soon)

    def _publish_soon(self) -> None:
        self._timer = None
        if self._publishing is not None and not self._publishing.done():
            self._again = True
            return
        self._publishing = self.loop.create_task(self._publish())

    async def _publish(self) -> None:
        while True:
            self._again = False
            try:
                await self._send_new(self._first_messages)
                if self._left and await self._work_on():
                    await self._send_new(self._all_messages)
            except Exception:
                # The sessions continue: the next change of a text tries again.
                log.exception("the messages of a program could not be worked out")
                return
            await self.run(self._prepare)
            if not self._again:
                self._tidy_later()
                return

    async def run(self, work: Callable[[], Any]) -> Any:
        """Do something in the thread, in turn with the requests of the sessions."""
        return await self.loop.run_in_executor(self.thread, work)

    async def _work_on(self) -> bool:
        """Do what is left, a while at a time; False when an edit has come: its messages go first."""
        while not await self.run(self._go_on):
            if self._again or self._timer is not None:
                return False
        return True

    async def _send_new(self, messages: Callable[[], list[Message]]) -> None:
        """Publish the messages that are new."""
        for session, params in await self.run(messages):
            await session.endpoint.notify("textDocument/publishDiagnostics", params, params.uri)

    def _first_messages(self) -> list[Message]:
        """What to publish first: everything that can be said without the texts of libraries that no program
        reaches, or, where an edit concerns many texts, that of the edited ones."""
        if not any(session.is_initialized for session in self._sessions):
            return []
        edited, self._edited_since = self.workspace.in_texts_of(self._edited_since), set()
        with deep_recursion():
            snapshots = self.workspace.first_snapshots(edited)
            self._left = any(snapshot.is_waiting for snapshot in snapshots)
            bodies_wait = any(snapshot.analysis.is_waiting for snapshot in snapshots)
            return self._new_messages(snapshots, edited if bodies_wait else None)

    def _go_on(self) -> bool:
        """Work for a while on what has been left for later; whether nothing is left."""
        with deep_recursion():
            return self.workspace.resume(SLICE_S)

    def _all_messages(self) -> list[Message]:
        """What to publish when nothing is left for later."""
        if self._timer is not None:
            return []
        with deep_recursion():
            return self._new_messages(self.workspace.snapshots(), None)

    def _new_messages(self, snapshots: list[Snapshot], only: set[str] | None) -> list[Message]:
        """What has to be published to each session, of all documents or of some."""
        found: dict[str, list[Report]] = {}
        for snapshot in snapshots:
            for document, entries in reports(snapshot, only).items():
                known = found.setdefault(document, [])
                known += [entry for entry in entries if entry not in known]
        published: Published = {}
        return [
            (session, params)
            for session in list(self._sessions)
            if session.is_initialized
            for params in session.publication.news(found, only, published)
        ]

    def _prepare(self) -> None:
        """Make the next check quick: the trees of a whole analysis are old enough to be left alone by the
        search for young garbage, which would look at each of them during the first edit."""
        self.workspace.prepare()
        if self._tidied != self.workspace.whole_analyses:
            gc.freeze()
            gc.unfreeze()

    def _tidy_later(self) -> None:
        """Look for garbage when there are no edits for a while."""
        left = self.workspace.whole_analyses - self._tidied
        if left:
            pause = IDLE_S if left < UNTIDY else 0.0
            self._tidying = self.loop.call_later(pause, self.thread.submit, self._tidy)

    def _tidy(self) -> None:
        """Look for the garbage of whole analyses while nobody waits for messages."""
        self._tidied = self.workspace.whole_analyses
        gc.collect()
