"""Connections that never ask anything: the server answers others, and its log stays short."""

from __future__ import annotations

import socket
from pathlib import Path

import httpx
from live_server import station, until

HALF_OPEN = 1100
"""They stopped the server once, and wrote 22 MB of log in half a minute."""


def test_half_open_connections_stop_nobody_else(tmp_path: Path) -> None:
    with station(tmp_path, "--no-runtime") as plant:
        port = int(plant.origin.rpartition(":")[2])
        before = plant.log.stat().st_size
        silent = []
        try:
            for _ in range(HALF_OPEN):
                silent.append(socket.create_connection(("127.0.0.1", port), 10, ("127.0.0.3", 0)))
                silent[-1].send(b"GET / HT")
            other = httpx.HTTPTransport(local_address="127.0.0.2")
            with httpx.Client(transport=other, timeout=30) as client:
                for _ in range(20):
                    assert client.get(f"{plant.base}/health").status_code == 200
            until(lambda: _answers(plant.base), "places are free again", 120)
        finally:
            for one in silent:
                one.close()
        assert plant.log.stat().st_size - before < 100_000


def _answers(base: str) -> bool:
    transport = httpx.HTTPTransport(local_address="127.0.0.3")
    try:
        with httpx.Client(transport=transport, timeout=30) as client:
            return client.get(f"{base}/health").status_code == 200
    except httpx.TransportError:
        return False
