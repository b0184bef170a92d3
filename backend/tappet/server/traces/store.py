"""Recordings on disk: a folder each, with `recording.json` and the samples of its records.

A folder holds all that is known of its recording, so that it can be copied, backed up and deleted as one; the
list of them is read once after the server has started. Together they take at most the quota of the
installation.
"""

from __future__ import annotations

import shutil
import threading
import uuid
from collections import OrderedDict
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Literal

import msgspec
from msgspec import Struct
from msgspec.structs import replace

from tappet.server.problems import Problem, not_found
from tappet.traces.chunks import StoredSamples
from tappet.traces.recording import RecordInfo
from tappet.traces.samples import Batch

_OPEN = 16
"""Recordings whose topmost level stays in memory."""
State = Literal["recording", "complete", "interrupted"]


class RecordingOrigin(Struct, frozen=True, kw_only=True):
    """What is known of a recording before its first sample."""

    title: str
    comment: str
    trace: str
    application: str
    runtime_id: str | None
    runtime: str
    project_id: str | None
    started_by: str
    settings: dict[str, Any]


class RecordingMeta(RecordingOrigin, frozen=True, kw_only=True):
    """`recording.json`."""

    id: str
    started_at: datetime
    records: list[RecordInfo]
    state: State = "complete"
    ended_at: datetime | None = None
    problem: str | None = None
    lost: int = 0


class StoredRecording:
    """A recording that is open."""

    def __init__(self, folder: Path, meta: RecordingMeta) -> None:
        self._folder = folder
        self.meta = meta
        self.lock = threading.Lock()
        """Samples are appended and read by worker threads."""
        self.records = [StoredSamples(folder, n, record.channels) for n, record in enumerate(meta.records)]

    @property
    def bytes(self) -> int:
        """On disk."""
        return sum(record.bytes for record in self.records)

    def append(self, record: int, batch: Batch) -> None:
        """Keep more samples."""
        with self.lock:
            self.records[record].append(batch)

    def flush(self) -> None:
        """Bring what is in memory to disk."""
        with self.lock:
            for record in self.records:
                record.flush()

    def change(self, **fields: Any) -> None:
        """Keep other facts."""
        self.meta = replace(self.meta, **fields)
        unfinished = self._folder / "recording.new"
        unfinished.write_bytes(msgspec.json.format(msgspec.json.encode(self.meta), indent=1))
        unfinished.replace(self._folder / "recording.json")


class RecordingStore:
    """All recordings of the server. Its methods block; any thread may call them."""

    def __init__(self, folder: Path, quota_bytes: int) -> None:
        self._folder = folder
        self.quota_bytes = quota_bytes
        self._lock = threading.RLock()
        self._known: dict[str, RecordingMeta] | None = None
        self._open: OrderedDict[str, StoredRecording] = OrderedDict()

    def _metas(self) -> dict[str, RecordingMeta]:
        if self._known is None:
            self._known = {}
            for path in sorted(self._folder.glob("*/recording.json")):
                try:
                    meta = msgspec.json.decode(path.read_bytes(), type=RecordingMeta)
                except (OSError, msgspec.MsgspecError):
                    continue  # of a newer version, or damaged: it is left alone
                self._known[meta.id] = meta
                if meta.state == "recording":  # the server ended before it did
                    self.get(meta.id).change(state="interrupted", problem="The server was ended.")
                    self._known[meta.id] = self._open[meta.id].meta
        return self._known

    def all(self) -> list[StoredRecording]:
        """Newest first."""
        with self._lock:
            metas = sorted(self._metas().values(), key=lambda m: m.started_at, reverse=True)
            return [self.get(meta.id) for meta in metas]

    def get(self, recording_id: str) -> StoredRecording:
        """One of them; raises a 404 problem."""
        with self._lock:
            meta = self._metas().get(recording_id)
            if meta is None:
                raise not_found("recording", recording_id)
            if recording_id not in self._open:
                self._open[recording_id] = StoredRecording(self._folder / recording_id, meta)
            self._open.move_to_end(recording_id)
            for old in list(self._open)[:-_OPEN]:
                if self._open[old].meta.state != "recording":
                    del self._open[old]
            return self._open[recording_id]

    def used(self) -> int:
        """Bytes of all of them."""
        with self._lock:
            return sum(self.get(recording_id).bytes for recording_id in list(self._metas()))

    def check_room(self) -> None:
        """Raises a 507 problem when the quota is used up."""
        used = self.used()
        if used >= self.quota_bytes:
            raise Problem(
                507,
                "recordings-full",
                f"The recordings take {used >> 20} MiB of {self.quota_bytes >> 20} MiB; delete some.",
            )

    def create(self, **fields: Any) -> StoredRecording:
        """A new recording without samples; raises a 507 problem when the quota is used up."""
        self.check_room()
        with self._lock:
            meta = RecordingMeta(id=uuid.uuid4().hex, started_at=datetime.now(UTC), **fields)
            folder = self._folder / meta.id
            folder.mkdir(parents=True, mode=0o700)
            self._metas()[meta.id] = meta
            recording = StoredRecording(folder, meta)
            recording.change()
            self._open[meta.id] = recording
            return recording

    def change(self, recording_id: str, **fields: Any) -> StoredRecording:
        """Other facts of a recording."""
        with self._lock:
            recording = self.get(recording_id)
            recording.change(**fields)
            self._metas()[recording_id] = recording.meta
            return recording

    def delete(self, recording_id: str) -> RecordingMeta:
        """Remove a recording; raises 404 and 409 problems."""
        with self._lock:
            recording = self.get(recording_id)
            if recording.meta.state == "recording":
                raise Problem(409, "still-recording", "The recording is still being made; end it first.")
            del self._metas()[recording_id]
            self._open.pop(recording_id, None)
            shutil.rmtree(self._folder / recording_id)
            return recording.meta
