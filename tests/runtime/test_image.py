"""The process image: low addresses, bounds, growth for online changes."""

import os

import pytest

from tappet.runtime.image import Image, ImageError
from tappet.runtime.posix import LOW_LIMIT, map_memory
from tappet.runtime.threads import GUARD_SIZE, TaskStack


def test_image_lies_below_4_gib() -> None:
    image = Image(100_000)
    assert image.low
    assert image.address + image.size <= LOW_LIMIT
    image.close()


def test_bytes_outside_are_refused() -> None:
    image = Image(100)
    for offset, size in ((-1, 1), (100, 1), (0, 101), (50, -1)):
        with pytest.raises(ValueError, match="outside the image of 100 bytes"):
            image.read(offset, size)
    image.close()


def test_growth_keeps_address_and_content() -> None:
    image = Image(4096)
    address = image.address
    image.write(10, b"kept")
    image.resize(200_000)
    assert (image.address, image.read(10, 4), image.read(199_999, 1)) == (address, b"kept", b"\0")
    with pytest.raises(ImageError, match="a download is needed"):
        image.resize(image.capacity + 1)
    image.close()


def test_a_closed_image_gives_its_memory_and_file_back() -> None:
    before = len(os.listdir("/proc/self/fd"))
    for _ in range(50):
        Image(1 << 20).close()
    assert len(os.listdir("/proc/self/fd")) == before


def test_stacks_lie_low_with_guard_pages() -> None:
    stack = TaskStack()
    assert stack.low
    protection = _protection(stack.mapping.address)
    assert protection.startswith("---")
    assert _protection(stack.mapping.address + GUARD_SIZE).startswith("rw-")
    stack.close()


def test_low_memory_without_the_mapping_flag(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("platform.machine", lambda: "riscv64")
    mapping = map_memory(1 << 16, low=True)
    assert mapping.low
    mapping.close()


def _protection(address: int) -> str:
    with open("/proc/self/maps", encoding="ascii") as maps:
        for line in maps:
            span, rights, *_ = line.split()
            low, high = (int(x, 16) for x in span.split("-"))
            if low <= address < high:
                return rights
    raise AssertionError("not mapped")
