"""One browser's socket: subscriptions in, state, forces and frames out."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import partial

from pydantic import BaseModel, TypeAdapter, ValidationError
from starlette.websockets import WebSocket

from tappet.runtime.recorder import Frame
from tappet.server.online.layout import HEADER, FrameLayout, lay_out
from tappet.server.online.outbox import Outbox
from tappet.server.online.past import PAST, read_past
from tappet.server.online.quota import Share, UserQuota
from tappet.server.online.sampler import SamplerPool, Sink
from tappet.server.online.shapes import (
    ClientMessage,
    ForcesChanged,
    ImagePlace,
    LookBack,
    LookedBack,
    OnlineError,
    Paced,
    Speak,
    StateChanged,
    Subscribe,
    Subscribed,
)
from tappet.server.problems import Problem
from tappet.server.runtimes.links import Change, RuntimeLink
from tappet.server.sockets import SessionWatch, close_with_session, until_one_ends
from tappet.server.spoken import in_language
from tappet.translation.language import Language

MOST_SUBSCRIPTIONS = 100
"""Of one socket."""
_MESSAGE: TypeAdapter[ClientMessage] = TypeAdapter(ClientMessage)


@dataclass(slots=True)
class _Subscription:
    order: Subscribe
    share: Share
    layout: FrameLayout
    detach: Callable[[], None] = field(default=lambda: None)


class OnlineChannel:
    """Serves one socket until it closes."""

    def __init__(
        self,
        socket: WebSocket,
        link: RuntimeLink,
        pool: SamplerPool,
        session: SessionWatch,
        quota: UserQuota,
    ) -> None:
        self._socket = socket
        self._link = link
        self._pool = pool
        self._session = session
        self._quota = quota
        self._subscriptions: dict[int, _Subscription] = {}
        self._language: Language = "en"
        self._past: int | None = None
        """The past cycle that all subscriptions show; None: live values."""
        self.outbox = Outbox()

    async def run(self) -> None:
        """Accepts the socket and serves it. Never raises for what the browser sends or how it leaves."""
        await self._socket.accept()
        self._enqueue(StateChanged(**self._link.state().model_dump()))
        self._enqueue(self._forces())
        ignore = self._link.listen(self._on_change)
        try:
            await until_one_ends(
                self._read, self._send, partial(close_with_session, self._socket, self._session)
            )
        finally:
            ignore()
            for subscription in self._subscriptions.values():
                subscription.detach()
                self._quota.leave(subscription.share)

    # -- in ------------------------------------------------------------------------------------------

    async def _read(self) -> None:
        while True:
            await self.outbox.wait_for_room()
            message = await self._socket.receive()
            if message["type"] == "websocket.disconnect":
                return
            text = message.get("text")
            if text is None:
                self._error(None, "Messages to this channel are JSON text, not binary.")
            else:
                await self._serve(text)

    async def _serve(self, text: str) -> None:
        try:
            order = _MESSAGE.validate_json(text)
        except ValidationError as error:
            first = error.errors(include_url=False, include_input=False, include_context=False)[0]
            place = ".".join(str(part) for part in first["loc"])
            self._error(None, f"{place}: {first['msg']}" if place else first["msg"])
            return
        if isinstance(order, Subscribe):
            await self._quota.pay(1 + len(order.expressions))
            self._subscribe(order)
            await self._show_past([order.id])
        elif isinstance(order, LookBack):
            await self._quota.pay(1 + sum(len(one.layout.places) for one in self._subscriptions.values()))
            await self._look_back(order.cycle)
        elif isinstance(order, Speak):
            await self._quota.pay(1 + len(self._subscriptions))
            self._speak(order.language)
        else:
            self._unsubscribe(order.id)

    def _speak(self, language: Language) -> None:
        if language != self._language:
            self._language = language
            self._on_change(Change.STATE)
            self._on_change(Change.APPLICATION)

    def _subscribe(self, order: Subscribe, *, renewed: bool = False) -> None:
        self._unsubscribe(order.id)
        if len(self._subscriptions) >= MOST_SUBSCRIPTIONS:
            self._error(order.id, f"One socket carries at most {MOST_SUBSCRIPTIONS} subscriptions.")
            return
        try:
            layout = lay_out(self._link.symbols, order.expressions)
            share = Share(HEADER.size + layout.size, order.interval_ms, len(order.expressions))
            interval_ms = self._quota.enter(share)
        except ValueError as error:
            self._error(order.id, str(error))
            return
        items = list(layout.items)
        self._enqueue(Subscribed(id=order.id, items=items, interval_ms=interval_ms, renewed=renewed))
        subscription = self._subscriptions[order.id] = _Subscription(order, share, layout)

        def paced(interval_ms: int) -> None:
            self._enqueue(Paced(id=order.id, interval_ms=interval_ms))
            self._attach(subscription, interval_ms)

        self._attach(subscription, interval_ms)
        share.paced = paced

    def _attach(self, subscription: _Subscription, interval_ms: int) -> None:
        """Live values from now on; none while the channel shows the past."""
        subscription.detach()
        subscription.detach = lambda: None
        places = subscription.layout.places
        if places and self._link.connected and self._past is None:
            sink = self._sink(subscription.order.id)
            subscription.detach = self._pool.attach(places, interval_ms, sink)

    # -- the past ------------------------------------------------------------------------------------

    async def _look_back(self, cycle: int | None) -> None:
        """All subscriptions show a past cycle; with None live values again. Where the cycle cannot be had
        everything stays as it is, and the answer says why."""
        before, self._past = self._past, cycle
        problem = await self._show_past(list(self._subscriptions)) if cycle is not None else None
        if problem is not None:
            self._past = before
        self._enqueue(LookedBack(cycle=self._past, problem=problem))
        if (before is None) != (self._past is None):
            for subscription in self._subscriptions.values():
                self._attach(subscription, self._quota.interval(subscription.share))
            self._enqueue(self._forces())

    async def _show_past(self, ids: Sequence[int]) -> str | None:
        """Sends a frame of the past cycle to these subscriptions; returns why not."""
        cycle = self._past
        if cycle is None:
            return None
        wanted = {id: self._subscriptions[id].layout.places for id in ids if id in self._subscriptions}
        try:
            frames = await read_past(self._link, cycle, wanted)
        except Problem as problem:
            return problem.detail
        for id, data in frames.items():
            self.outbox.put_frame(id, HEADER.pack(id, PAST, cycle, 0) + data)
        return None

    def _leave_past(self) -> None:
        """The cycle shown belongs to what is no longer loaded."""
        if self._past is not None:
            self._past = None
            self._enqueue(LookedBack(cycle=None, problem=None))
            self._enqueue(self._forces())

    def _sink(self, subscription: int) -> Sink:
        def sink(frame: Frame) -> None:
            header = HEADER.pack(subscription, 0, frame.cycle, frame.timestamp_ns)
            self.outbox.put_frame(subscription, header + frame.data)

        return sink

    def _unsubscribe(self, subscription: int) -> None:
        known = self._subscriptions.pop(subscription, None)
        if known is not None:
            known.detach()
            self._quota.leave(known.share)
        self.outbox.drop_frame(subscription)

    # -- out -----------------------------------------------------------------------------------------

    def _forces(self) -> ForcesChanged:
        """The present forces; of a past cycle it is not kept what was forced."""
        if self._past is not None:
            return ForcesChanged(expressions=[], places=[])
        sizes = sorted(self._link.forced_sizes.items(), key=lambda entry: (entry[0][0], entry[0][1] or 0))
        places = [ImagePlace(offset=offset, size=size, bit=bit) for (offset, bit), size in sizes]
        return ForcesChanged(expressions=sorted(self._link.forced.values()), places=places)

    def _on_change(self, change: Change) -> None:
        if change is Change.STATE:
            self._enqueue(StateChanged(**self._link.state().model_dump()))
        elif change is Change.FORCES:
            self._enqueue(self._forces())
        elif change is Change.APPLICATION:
            self._leave_past()
            for subscription in list(self._subscriptions.values()):
                self._subscribe(subscription.order, renewed=True)

    async def _send(self) -> None:
        while True:
            item = await self.outbox.take()
            if isinstance(item, str):
                await self._socket.send_text(item)
            else:
                await self._socket.send_bytes(item)

    def _enqueue(self, message: BaseModel) -> None:
        self.outbox.put_message(in_language(message, self._language).model_dump_json())

    def _error(self, subscription: int | None, detail: str) -> None:
        self._enqueue(OnlineError(id=subscription, detail=detail))
