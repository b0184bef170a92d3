"""viser servers that only this server reaches: on UNIX sockets in a folder that is closed to other users.

viser itself listens on a TCP port without asking who connects: any web page that the user looks at, and any
user of the machine, could read and change the scene. It has no setting for that; what it calls to listen is
replaced here, for viser alone. It also opens a tunnel to a public server when a browser asks, which is
refused here.
"""

from __future__ import annotations

import shutil
import tempfile
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import viser
import websockets
from viser.infra import _infra
from websockets.asyncio.server import ServerConnection, unix_serve

MOST_PATH = 100
"""Bytes of the name of a UNIX socket; Linux takes 107."""


def _listen(handler: Any, host: str, port: int, **options: Any) -> Any:
    """Listens on the socket that is given as host."""
    return unix_serve(handler, host, **options)


def _on_unix_sockets() -> SimpleNamespace:
    """What viser needs of websockets, with `_listen` for `serve`."""
    server = SimpleNamespace(serve=_listen, ServerConnection=ServerConnection)
    return SimpleNamespace(
        asyncio=SimpleNamespace(server=server),
        datastructures=websockets.datastructures,
        exceptions=websockets.exceptions,
    )


class PrivateViser(viser.ViserServer):
    """A viser server on `socket`."""

    def __init__(self) -> None:
        self._folder = Path(tempfile.mkdtemp(prefix="tappet-"))  # 0700
        self.socket = self._folder / "viser"
        if len(str(self.socket)) > MOST_PATH:
            shutil.rmtree(self._folder)
            raise OSError(f"the path of the folder for temporary files is too long: {self._folder.parent}")
        vars(_infra)["websockets"] = _on_unix_sockets()
        super().__init__(host=str(self.socket), port=0, verbose=False)

    def request_share_url(self, verbose: bool = True) -> str | None:
        """Nothing: a scene of a machine is shown to nobody outside."""
        return None

    def stop(self) -> None:
        """Ends it."""
        super().stop()
        shutil.rmtree(self._folder, ignore_errors=True)
