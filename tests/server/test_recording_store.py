"""Stored recordings: their index in the database against their folders, and their limits."""

from __future__ import annotations

import shutil
import sys
from collections.abc import Iterator
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.project import conftest as databases

from tappet.project.store import Store
from tappet.server.database import Database
from tappet.server.problems import Problem
from tappet.server.traces.index import RecordingIndex, Wanted
from tappet.server.traces.store import RecordingStore, StoredRecording
from tappet.traces.chunks import CHUNK
from tappet.traces.recording import RecordInfo
from tappet.traces.samples import Batch

sys.path.insert(0, str(Path(__file__).parents[1] / "traces"))
from sampled_batches import CHANNELS, batch

postgres_server, postgres_url = databases.postgres_server, databases.postgres_url
BEGUN = datetime(2026, 3, 1, 12, tzinfo=UTC)
FIELDS: dict[str, Any] = {
    "title": "Run",
    "comment": "",
    "trace": "Trace",
    "application": "App",
    "runtime_id": "local",
    "runtime": "Local",
    "project_id": "p",
    "started_by": "ann",
    "settings": {"records": []},
}


@pytest.fixture(params=["sqlite", pytest.param("postgres", marks=pytest.mark.postgres)])
def database(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[Database]:
    url = (
        f"sqlite:///{tmp_path}/t.db" if request.param == "sqlite" else request.getfixturevalue("postgres_url")
    )
    opened = Store(url)
    yield Database(opened.engine)
    opened.close()


def _store(database: Database, folder: Path, quota: int = 1 << 40) -> RecordingStore:
    return RecordingStore(folder, quota, RecordingIndex(database))


def _recorded(store: RecordingStore, samples: Batch, **fields: Any) -> StoredRecording:
    records = [RecordInfo("Record1", "Main", 1_000_000, 1, CHANNELS)]
    recording = store.create(**(FIELDS | {"records": records} | fields))
    recording.append(0, samples)
    store.flush(recording)
    return recording


def _moved(samples: Batch, begun: datetime) -> Batch:
    """Samples from a moment on."""
    offset = int(begun.timestamp()) * 1_000_000_000 - int(samples.time[0])
    return Batch(samples.cycle, samples.time + offset, samples.gap, samples.values)


def test_lists_are_filtered_by_runtime_trace_project_and_time(database: Database, tmp_path: Path) -> None:
    store = _store(database, tmp_path / "r")
    hour = timedelta(hours=1)
    made = {
        (runtime, trace, number): _recorded(
            store, _moved(batch(100, holes=False), BEGUN + number * hour), runtime_id=runtime, trace=trace
        ).meta.id
        for runtime in ("a", "b")
        for trace in ("Fast", "Slow")
        for number in range(3)
    }

    def listed(**wanted: Any) -> set[str]:
        return {row["id"] for row in store.found(Wanted(**wanted))}

    def expected(keep: Any) -> set[str]:
        return {one for key, one in made.items() if keep(*key)}

    assert listed() == set(made.values())
    assert listed(runtime_id="a") == expected(lambda runtime, *_: runtime == "a")
    assert listed(trace="fast") == expected(lambda _, trace, __: trace == "Fast")
    assert listed(project_id="q") == set()
    assert listed(start=BEGUN + hour) == expected(lambda _, __, number: number >= 1)
    assert listed(end=BEGUN + hour) == expected(lambda _, __, number: number < 1)
    assert listed(start=BEGUN + hour, end=BEGUN + 2 * hour, runtime_id="b") == expected(
        lambda runtime, _, number: runtime == "b" and number == 1
    )


def test_rows_say_what_the_samples_say(database: Database, tmp_path: Path) -> None:
    samples = batch(3 * CHUNK + 77)
    store = _store(database, tmp_path / "r")
    recording = _recorded(store, samples)
    (row,) = store.found(Wanted())
    assert (row["first_ns"], row["last_ns"]) == (int(samples.time[0]), int(samples.time[-1]))
    (record,) = row["records"]
    assert record["samples"] == len(samples)
    assert record["first_ns"] == str(int(samples.time[0]))
    assert [channel["name"] for channel in record["channels"]] == [channel.name for channel in CHANNELS]
    assert row["bytes"] == recording.bytes == store.used()
    store.change(row["id"], title="Better", comment="good")
    (row,) = store.found(Wanted())
    assert (row["title"], row["comment"]) == ("Better", "good")
    store.delete(row["id"])
    assert (store.found(Wanted()), store.used()) == ([], 0)


def test_folders_are_found_again_and_lost_ones_forgotten(database: Database, tmp_path: Path) -> None:
    """Of an older version, copied, restored, removed by hand, or left by a server that was killed."""
    folder = tmp_path / "r"
    store = _store(database, folder)
    kept, lost, open_one = (_recorded(store, batch(200 + n), title=f"Run {n}").meta.id for n in range(3))
    store.change(open_one, state="recording")
    RecordingIndex(database).remove(kept)
    shutil.rmtree(folder / lost)
    (folder / "damaged").mkdir()
    (folder / "damaged" / "recording.json").write_text("{")
    again = _store(database, folder)
    rows = {row["id"]: row for row in again.found(Wanted())}
    assert rows.keys() == {kept, open_one}
    assert rows[kept]["records"][0]["samples"] == 200
    assert (rows[open_one]["state"], rows[open_one]["problem"]) == ("interrupted", "The server was ended.")
    assert again.get(open_one).meta.state == "interrupted"
    with pytest.raises(Problem, match="recording"):
        again.get(lost)


def test_a_recording_keeps_to_its_limit_of_age(database: Database, tmp_path: Path) -> None:
    store = _store(database, tmp_path / "r")
    whole = batch(20 * CHUNK, holes=False)
    seconds = 30
    recording = _recorded(store, whole.part(0, 3 * CHUNK), keep_seconds=seconds)
    for start in range(3 * CHUNK, len(whole), CHUNK):
        recording.append(0, whole.part(start, start + CHUNK))
        store.flush(recording)
        have = recording.records[0]
        newest = int(whole.time[start + CHUNK - 1])
        cycles = have.cycles(0, have.count)
        # All that is young enough is there, and at most a chunk that is not.
        young = whole.cycle[: start + CHUNK][whole.time[: start + CHUNK] >= newest - seconds * 10**9]
        assert cycles[0] <= young[0]
        assert len(cycles) <= len(young) + CHUNK
        assert np.array_equal(cycles, whole.cycle[start + CHUNK - len(cycles) : start + CHUNK])
    (row,) = store.found(Wanted())
    assert row["dropped"] == len(whole) - recording.records[0].count > 0
    assert row["keep_seconds"] == seconds


def test_recordings_older_than_the_installation_keeps_are_deleted(database: Database, tmp_path: Path) -> None:
    """By the end of the recording, or by when it was stored; what goes on stays."""
    folder, day = tmp_path / "r", timedelta(days=1)
    store = RecordingStore(folder, 1 << 40, RecordingIndex(database), keep=30 * day)
    now = datetime.now(UTC)

    def ended(ago: timedelta | None, **fields: Any) -> str:
        return _recorded(store, batch(300), ended_at=None if ago is None else now - ago, **fields).meta.id

    old, older = ended(31 * day, title="old"), ended(40 * day, title="older", state="interrupted")
    young, stored, open_one = ended(29 * day), ended(None), ended(None, state="recording")
    assert [meta.title for meta in store.delete_expired(now)] == ["older", "old"]
    assert {row["id"] for row in store.found(Wanted())} == {young, stored, open_one}
    assert not (folder / old).exists()
    assert not (folder / older).exists()
    assert store.delete_expired(now) == []
    assert {meta.id for meta in store.delete_expired(now + 2 * day)} == {young}
    assert {meta.id for meta in store.delete_expired(now + 31 * day)} == {stored}
    assert [row["id"] for row in store.found(Wanted())] == [open_one]
    unlimited = _store(database, folder)
    assert unlimited.delete_expired(now + 1000 * day) == []


def test_a_recording_that_goes_on_drops_what_the_installation_does_not_keep(
    database: Database, tmp_path: Path
) -> None:
    seconds = 20
    store = RecordingStore(tmp_path / "r", 1 << 40, RecordingIndex(database), keep=timedelta(seconds=seconds))
    whole = batch(12 * CHUNK, holes=False)
    for own, state in ((None, "recording"), (3600, "recording"), (None, "complete")):
        recording = _recorded(store, whole, keep_seconds=own, state=state)
        young = np.count_nonzero(whole.time >= int(whole.time[-1]) - seconds * 10**9)
        if state == "complete":
            assert recording.records[0].count == len(whole)
        else:
            assert young <= recording.records[0].count <= young + CHUNK < len(whole)


def test_a_recording_keeps_to_its_limit_of_size(database: Database, tmp_path: Path) -> None:
    """Two records share the limit; the oldest samples of both go first."""
    store = _store(database, tmp_path / "r")
    records = [RecordInfo(f"Record{n}", "Main", 1_000_000, 1, CHANNELS) for n in (1, 2)]
    limit = 1 << 20
    recording = store.create(**FIELDS, records=records, keep_bytes=limit)
    whole = batch(24 * CHUNK, holes=False)
    for start in range(0, len(whole), CHUNK):
        for number in range(2):
            recording.append(number, whole.part(start, start + CHUNK))
        store.flush(recording)
        # Pages at the edges of holes stay, and the samples that fill no chunk yet.
        assert recording.bytes <= limit + 2 * 5 * 4096
    first, second = (record.first_ns or 0 for record in recording.records)
    assert abs(first - second) <= CHUNK * 1_000_000
    assert all(record.last_ns == int(whole.time[-1]) for record in recording.records)
    assert recording.bytes > limit / 2
