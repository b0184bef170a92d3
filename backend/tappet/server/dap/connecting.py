"""From a built application to a debuggee: on a runtime process of its own, or on a runtime that is there."""

from __future__ import annotations

import asyncio
import tempfile
from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import TypeVar

from tappet import libraries
from tappet.codegen.package import CodePackage
from tappet.runtime.client import ConnectionLost, RuntimeClient, RuntimeRefused
from tappet.runtime.operations.declaration import WireOperation
from tappet.runtime.operations.life_cycle import GetInfo
from tappet.runtime.process import RuntimeProcess, StartError
from tappet.server.dap.debuggee import Refused
from tappet.server.dap.program_files import Texts
from tappet.server.dap.runtime_debuggee import RuntimeDebuggee

T = TypeVar("T")
MakeVariant = Callable[[], Awaitable[bytes]]
"""Compiles the instrumented variant of the package. Raises Refused."""


class ClientCaller:
    """Calls over a connection of its own."""

    def __init__(self, client: RuntimeClient) -> None:
        self._client = client

    async def call(self, operation: WireOperation[T]) -> T:
        """The reply to an operation."""
        return await self._client.call(operation)

    def on_event(self, callback: Callable[[], None]) -> None:
        """At every event of the runtime."""
        self._client.on_event(lambda _event: callback())


async def launch(package: CodePackage, variant: MakeVariant, texts: Texts) -> RuntimeDebuggee:
    """Load the application into a runtime process that ends with the session. Raises Refused."""
    folder = tempfile.TemporaryDirectory(prefix="tappet-dap-")
    try:
        process = await RuntimeProcess.start(Path(folder.name), restart=False)
    except (StartError, OSError) as error:
        folder.cleanup()
        raise Refused(str(error)) from error

    async def end() -> None:
        await process.stop()
        folder.cleanup()

    try:
        assert process.endpoint is not None
        debuggee = await attach(
            process.endpoint.url, process.endpoint.token, package, variant, texts, download=True
        )
    except BaseException:
        await end()
        raise
    debuggee.at_end(end)
    return debuggee


async def attach(
    url: str, token: str, package: CodePackage, variant: MakeVariant, texts: Texts, *, download: bool
) -> RuntimeDebuggee:
    """The application on a runtime; with `download` it is loaded where it is not there. Raises Refused."""
    try:
        client = await RuntimeClient.connect(url, token)
    except ConnectionLost as error:
        raise Refused(str(error)) from error
    try:
        same = (await client.call(GetInfo())).code_id == package.code_id
        if not same and not download:
            raise Refused(
                f"{url} runs something else than what is built of these files: download that first, or set"
                " 'download' to true"
            )
        if not same:
            await client.download(package.to_bytes())
    except (Refused, RuntimeRefused) as error:
        await client.close()
        raise Refused(str(error)) from error
    loading, loaded = asyncio.Lock(), False

    async def load_variant() -> None:
        nonlocal loaded
        async with loading:
            if not loaded:
                await client.load_variant(await variant())
                loaded = True

    debuggee = RuntimeDebuggee(ClientCaller(client), package, load_variant, texts, library_text)
    debuggee.at_end(client.close)
    return debuggee


def library_text(reference: str) -> str | None:
    """The text of a library by its uri, such as `Standard/TON` or `Util 1.2.0.0/BLINK`."""
    label = reference.partition("/")[0]
    for library in libraries.every_version():
        if label in (library.name, f"{library.name} {library.version}"):
            for source in library.sources:
                if source.uri == reference:
                    return source.text
    return None
