"""Recordings on disk: a folder each, with `recording.json` and the samples of its records.

A folder holds all that is known of its recording, so that it can be copied, backed up and deleted as one.
Lists come from the index in the database, which is brought up to date with the folders once after the server
has started. Together recordings take at most the quota of the installation, and none becomes older than its
limit of age; a recording that goes on may have limits of its own, by which it drops its oldest samples.
"""

from __future__ import annotations

import shutil
import threading
import uuid
from collections import OrderedDict
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import msgspec
from msgspec import Struct, structs
from msgspec.structs import replace

from tappet.server.problems import Problem, not_found
from tappet.server.traces.index import RecordingIndex, Wanted
from tappet.traces.recording import RecordInfo

if TYPE_CHECKING:
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
    keep_bytes: int | None = None
    """Of a long-term recording: where it takes more, its oldest samples are dropped."""
    keep_seconds: int | None = None
    """The same by age, counted from its newest sample."""


class RecordingMeta(RecordingOrigin, frozen=True, kw_only=True):
    """`recording.json`."""

    id: str
    started_at: datetime
    records: list[RecordInfo]
    state: State = "complete"
    ended_at: datetime | None = None
    problem: str | None = None
    lost: int = 0


def _text(ns: int | None) -> str | None:
    """A time for JSON, whose numbers are too small for it."""
    return None if ns is None else str(ns)


class StoredRecording:
    """A recording that is open."""

    def __init__(self, folder: Path, meta: RecordingMeta) -> None:
        from tappet.traces.chunks import StoredSamples

        self._folder = folder
        self.meta = meta
        self.lock = threading.Lock()
        """Samples are appended and read by worker threads."""
        self.records = [StoredSamples(folder, n, record.channels) for n, record in enumerate(meta.records)]

    @property
    def bytes(self) -> int:
        """On disk."""
        return sum(record.bytes for record in self.records)

    @property
    def dropped(self) -> int:
        """Samples that its limits have cost."""
        return max((record.dropped for record in self.records), default=0)

    def trim(self, keep: timedelta | None = None) -> None:
        """Drop the oldest samples that are beyond the limits, and beyond that of the installation."""
        keep_bytes, keep_seconds = self.meta.keep_bytes, self.meta.keep_seconds
        ages = [] if keep_seconds is None else [keep_seconds * 1_000_000_000]
        if keep is not None:
            ages.append(keep // timedelta(microseconds=1) * 1000)
        with self.lock:
            if ages:
                for record in self.records:
                    record.drop(record.chunks_before((record.last_ns or 0) - min(ages)))
            over = 0 if keep_bytes is None else self.bytes - keep_bytes
            while over > 0:
                oldest = min(self.records, key=lambda record: record.first_ns or 0)
                before = oldest.dropped
                oldest.drop(1)
                if oldest.dropped == before:
                    return
                over -= oldest.bytes_per_chunk

    def row(self) -> dict[str, Any]:
        """What the index keeps of it."""
        known = structs.asdict(self.meta)
        del known["settings"], known["records"]
        with self.lock:
            pairs = list(zip(self.meta.records, self.records, strict=True))
            records = [
                {
                    "name": info.name,
                    "task": info.task,
                    "interval_ns": info.interval_ns,
                    "samples": samples.count,
                    "first_ns": _text(samples.first_ns),
                    "last_ns": _text(samples.last_ns),
                    "trigger_ns": _text(info.trigger_ns),
                    "channels": [{"index": c.index, "name": c.name, "type": c.type} for c in info.channels],
                }
                for info, samples in pairs
            ]
            firsts = [samples.first_ns for _, samples in pairs if samples.first_ns is not None]
            lasts = [samples.last_ns for _, samples in pairs if samples.last_ns is not None]
            return known | {
                "records": records,
                "bytes": self.bytes,
                "dropped": self.dropped,
                "first_ns": min(firsts, default=None),
                "last_ns": max(lasts, default=None),
            }

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

    def __init__(
        self, folder: Path, quota_bytes: int, index: RecordingIndex, keep: timedelta | None = None
    ) -> None:
        self._folder = folder
        self.quota_bytes = quota_bytes
        self.keep = keep
        """How old a recording becomes; None: as old as it likes."""
        self._index = index
        self._lock = threading.RLock()
        self._compared = False
        self._open: OrderedDict[str, StoredRecording] = OrderedDict()

    def _compare(self) -> None:
        """Bring the index up to date with the folders, once: they may have been restored or removed."""
        if self._compared:
            return
        self._compared = True
        indexed = self._index.states()
        folders = {path.parent.name for path in self._folder.glob("*/recording.json")}
        self._index.remove(*(indexed.keys() - folders))
        unfinished = {one for one, state in indexed.items() if state == "recording"}
        for recording_id in sorted(folders - (indexed.keys() - unfinished)):
            try:
                recording = self._opened(recording_id)
            except Problem:
                continue  # of a newer version, or damaged: it is left alone
            if recording.meta.state == "recording":  # the server ended before it did
                recording.change(state="interrupted", problem="The server was ended.")
            self._index.put(recording.row())

    def found(self, wanted: Wanted) -> list[dict[str, Any]]:
        """Rows of the index, newest first."""
        with self._lock:
            self._compare()
        return self._index.found(wanted)

    def get(self, recording_id: str) -> StoredRecording:
        """One of them; raises a 404 problem."""
        with self._lock:
            self._compare()
            return self._opened(recording_id)

    def _opened(self, recording_id: str) -> StoredRecording:
        if recording_id not in self._open:
            folder = self._folder / recording_id
            try:
                meta = msgspec.json.decode((folder / "recording.json").read_bytes(), type=RecordingMeta)
            except (OSError, msgspec.MsgspecError) as error:
                raise not_found("recording", recording_id) from error
            self._open[recording_id] = StoredRecording(folder, meta)
        self._open.move_to_end(recording_id)
        for old in list(self._open)[:-_OPEN]:
            if self._open[old].meta.state != "recording":
                del self._open[old]
        return self._open[recording_id]

    def used(self) -> int:
        """Bytes of all of them."""
        with self._lock:
            self._compare()
        return self._index.used()

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
            recording = StoredRecording(folder, meta)
            recording.change()
            self._open[meta.id] = recording
            self._index.put(recording.row())
            return recording

    def flush(self, recording: StoredRecording) -> None:
        """Bring what is in memory to disk, drop what is beyond its limits, and tell the index."""
        recording.flush()
        recording.trim(self.keep if recording.meta.state == "recording" else None)
        self._index.put(recording.row())

    def change(self, recording_id: str, **fields: Any) -> StoredRecording:
        """Other facts of a recording."""
        with self._lock:
            recording = self.get(recording_id)
            recording.change(**fields)
            self._index.put(recording.row())
            return recording

    def delete_expired(self, now: datetime) -> list[RecordingMeta]:
        """Delete the recordings that ended, or were stored, before the limit of age; what they were."""
        if self.keep is None:
            return []
        with self._lock:
            self._compare()
            deleted = []
            for one in self._index.ended_before(now - self.keep):
                try:
                    deleted.append(self.delete(one))
                except Problem:
                    continue  # damaged, or removed by hand: it is left alone
            return deleted

    def delete(self, recording_id: str) -> RecordingMeta:
        """Remove a recording; raises 404 and 409 problems."""
        with self._lock:
            recording = self.get(recording_id)
            if recording.meta.state == "recording":
                raise Problem(409, "still-recording", "The recording is still being made; end it first.")
            self._open.pop(recording_id, None)
            shutil.rmtree(self._folder / recording_id)
            self._index.remove(recording_id)
            return recording.meta
