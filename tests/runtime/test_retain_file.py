"""Retain files: the newest complete slot counts, damage is named, nothing foreign gets through."""

import contextlib
import os
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tappet.codegen.package import RemanentRange
from tappet.runtime.executive.loader import Executive
from tappet.runtime.image import Image
from tappet.runtime.retain import (
    LIVE,
    SAVED,
    KeptValue,
    Remanent,
    RetainError,
    RetainFile,
    load_retain,
    matching,
    parse_retain,
)

COUNT = Remanent(RemanentRange("GVL.count", 16, 4, "DINT"), False)
HOURS = Remanent(RemanentRange("Pers.hours", 24, 8, "LREAL"), True)
NAME = Remanent(RemanentRange("Pers.name", 40, 5, "STRING(4)"), True)


@pytest.fixture
def image() -> Image:
    return Image(4096)


@pytest.fixture
def file(tmp_path: Path, image: Image) -> RetainFile:
    image.write(16, (7).to_bytes(4, "little"))
    return RetainFile(Executive.shared(), tmp_path / LIVE, [[COUNT, HOURS], [NAME]], image.address)


def save(file: RetainFile) -> None:
    for group in file.groups:
        Executive.shared().save_retain(group.address)


def test_present_values_are_in_a_new_file(file: RetainFile) -> None:
    kept = parse_retain(file.path.read_bytes())
    assert kept["GVL.COUNT"] == KeptValue("DINT", (7).to_bytes(4, "little"), False)
    assert kept["PERS.NAME"] == KeptValue("STRING(4)", b"\0" * 5, True)


def test_saving_alternates_between_two_slots(file: RetainFile, image: Image) -> None:
    slots = set()
    for number in range(8, 14):
        image.write(16, number.to_bytes(4, "little"))
        save(file)
        slots.add(file.groups[0]["current"])
        assert parse_retain(file.path.read_bytes())["GVL.COUNT"].data == number.to_bytes(4, "little")
    assert slots == {0, 1}


def test_unchanged_values_are_not_written_again(file: RetainFile) -> None:
    before = file.groups[0]["sequence"]
    save(file)
    assert file.groups[0]["sequence"] == before


def test_a_torn_slot_gives_the_values_before(file: RetainFile, image: Image) -> None:
    image.write(16, (8).to_bytes(4, "little"))
    save(file)
    data = bytearray(file.path.read_bytes())
    at = data.rindex((8).to_bytes(4, "little"))
    data[at] ^= 0xFF
    assert parse_retain(bytes(data))["GVL.COUNT"].data == (7).to_bytes(4, "little")


def test_two_torn_slots_are_an_error(file: RetainFile, image: Image) -> None:
    image.write(16, (8).to_bytes(4, "little"))
    save(file)
    data = bytearray(file.path.read_bytes())
    for number in (7, 8):
        data[data.rindex(number.to_bytes(4, "little") + b"\0\0\0\0")] ^= 0x55
    with pytest.raises(RetainError, match="no slot"):
        parse_retain(bytes(data))


def test_saved_copy_counts_when_the_live_file_is_damaged(
    file: RetainFile, image: Image, tmp_path: Path
) -> None:
    file.save()
    (tmp_path / LIVE).write_bytes(b"garbage" * 100)
    kept, problems = load_retain(tmp_path)
    assert kept["GVL.COUNT"].data == (7).to_bytes(4, "little")
    assert problems == ["retain.live: not a retain file"]


def test_nothing_kept_in_an_empty_folder(tmp_path: Path) -> None:
    assert load_retain(tmp_path) == ({}, [])


def test_files_are_private(file: RetainFile) -> None:
    file.save()
    assert [os.stat(file.path.with_name(n)).st_mode & 0o777 for n in (LIVE, SAVED)] == [0o600, 0o600]


def test_values_match_by_path_and_type(file: RetainFile) -> None:
    kept = parse_retain(file.path.read_bytes())
    moved = Remanent(RemanentRange("gvl.COUNT", 1000, 4, "DINT"), False)
    changed = Remanent(RemanentRange("Pers.hours", 24, 8, "LINT"), True)
    restored, lost = matching(kept, [moved, changed])
    assert [(r.offset, data) for r, data in restored] == [(1000, (7).to_bytes(4, "little"))]
    assert sorted(lost) == ["PERS.HOURS", "PERS.NAME"]


@given(st.binary(max_size=400))
def test_any_bytes_give_values_or_a_retain_error(data: bytes) -> None:
    with pytest.raises(RetainError):
        parse_retain(data)


def test_every_cut_and_every_flipped_byte_gives_values_of_one_cycle_or_an_error(
    file: RetainFile, image: Image, tmp_path: Path
) -> None:
    """Two cycles are in the slots; the copy that was saved holds the one before them."""
    file.save()
    saved = parse_retain((tmp_path / SAVED).read_bytes())
    cycles = []
    for number in (8, 9):
        image.write(16, number.to_bytes(4, "little"))
        image.write(40, b"v%d" % number)
        save(file)
        cycles.append(parse_retain(file.path.read_bytes()))
    content = file.path.read_bytes()
    older, newer = cycles

    def outcomes(damaged: bytes) -> dict[str, object]:
        try:
            kept = parse_retain(damaged)
        except RetainError as error:
            return {"error": str(error)}
        # groups are those of different tasks: each is of one cycle by itself
        for names in (("GVL.COUNT", "PERS.HOURS"), ("PERS.NAME",)):
            values = [kept[name] for name in names]
            assert values in ([older[name] for name in names], [newer[name] for name in names])
        return {"kept": kept}

    found = {"error": 0, "kept": 0}
    for size in range(len(content)):
        found.update({key: found[key] + 1 for key in outcomes(content[:size])})
    assert found["error"] > 0
    assert outcomes(content[:0]) == {"error": "shorter than its header"}
    damaged = bytearray(content)
    for at in range(len(content)):
        damaged[at] ^= 0xFF
        outcomes(bytes(damaged))
        damaged[at] ^= 0xFF
    # an error of the live file: what was saved as a whole is taken
    for size in range(200):
        file.path.write_bytes(content[:size])
        assert load_retain(tmp_path)[0] == saved


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=200)
@given(st.data())
def test_a_damaged_file_never_gives_wrong_values(file: RetainFile, data: st.DataObject) -> None:
    content = bytearray(file.path.read_bytes())
    good = parse_retain(bytes(content))
    for _ in range(data.draw(st.integers(1, 4))):
        content[data.draw(st.integers(0, len(content) - 1))] = data.draw(st.integers(0, 255))
    with contextlib.suppress(RetainError):
        assert parse_retain(bytes(content)) == good
