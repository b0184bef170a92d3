"""What the web server keeps of a browser, to replay it to an analysis that starts again."""

from __future__ import annotations

import asyncio
import json
from typing import Any

from hypothesis import given, settings
from hypothesis import strategies as st
from lsp_project import BODY, HEAD, start

from tappet.server.analysis import messages
from tappet.server.analysis.client import Client
from tappet.server.lsp.open_documents import OpenDocument
from tappet.server.lsp.session import Attached

NUMBERS = st.sampled_from([*range(9)] * 4 + [-1, 2**31, 2**64, 10**30, 1.5, True, None, "1"])
TEXTS = st.text(st.sampled_from("a\n\\u\ud800\udc00\U0001f600"), max_size=6) | st.sampled_from([5, None])
URIS = st.sampled_from([BODY, HEAD, "x\ud800"])
POSITIONS = st.fixed_dictionaries({"line": NUMBERS, "character": NUMBERS})
RANGES = st.none() | st.fixed_dictionaries({"start": POSITIONS, "end": POSITIONS})
CHANGES = st.fixed_dictionaries({"text": TEXTS}, optional={"range": RANGES}) | st.just(5)
OPENED = st.fixed_dictionaries(
    {"textDocument": st.fixed_dictionaries({"uri": URIS, "version": NUMBERS, "text": TEXTS})}
)
CHANGED = st.fixed_dictionaries(
    {
        "textDocument": st.fixed_dictionaries({"uri": URIS, "version": NUMBERS}),
        "contentChanges": st.lists(CHANGES, max_size=3),
    }
)
CLOSED = st.fixed_dictionaries({"textDocument": st.fixed_dictionaries({"uri": URIS})})
SAID = (
    st.tuples(st.just("textDocument/didOpen"), OPENED)
    | st.tuples(st.just("textDocument/didChange"), CHANGED)
    | st.tuples(st.just("textDocument/didClose"), CLOSED)
    | st.tuples(st.just("workspace/didChangeConfiguration"), CLOSED | st.just([10**30]))
)


def notification(method: str, params: Any) -> str:
    item = params.get("textDocument") if isinstance(params, dict) else None
    if item is not None:
        item = item | {"languageId": "iec-st"}
        params = params | {"textDocument": item}
    return json.dumps({"jsonrpc": "2.0", "method": method, "params": params})


@settings(max_examples=60, deadline=None)
@given(st.lists(SAID, max_size=8))
def test_the_web_server_follows_what_the_analysis_takes(said: list[tuple[str, Any]]) -> None:
    async def run() -> None:
        followed = Client(1)
        begin = {
            "jsonrpc": "2.0",
            "id": 1,
            "method": "initialize",
            "params": {"capabilities": {}, "x": 10**30},
        }
        followed.note(json.dumps(begin))
        followed.take(messages.Send(1, "{}", answers=1))
        async with start() as client:
            await client.start()
            for method, params in said:
                text = notification(method, params)
                followed.note(text)
                await client.raw(text)
            await client.session.endpoint.settle()
            taken = [client.session.documents.get(uri) for uri in client.session.documents]
        reader = asyncio.StreamReader()
        reader.feed_data(messages.frame(followed.attach()))
        reader.feed_eof()
        (crossed,) = [message async for message in messages.messages_to_worker(reader)]
        assert isinstance(crossed, messages.Attach)
        documents = tuple(OpenDocument(d.uri, d.version, d.text) for d in crossed.documents)
        assert list(documents) == taken
        async with start() as later:
            later.session.take_over(Attached(crossed.initialize, crossed.configuration, documents))
            await later.session.endpoint.settle()
            assert later.session.is_initialized
            assert [later.session.documents.get(uri) for uri in later.session.documents] == taken

    asyncio.run(run())
