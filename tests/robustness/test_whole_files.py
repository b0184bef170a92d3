"""Files are replaced as a whole: a full disk, an error or a link never leaves half of one."""

from __future__ import annotations

import errno
import os
from contextlib import suppress
from pathlib import Path

import pytest

from tappet.disk_full import is_disk_full
from tappet.whole_file import PRIVATE, replace_file, replacing_file, write_output


def _full(*_: object) -> int:
    raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))


def test_without_room_the_old_content_stays_and_nothing_else(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "a"
    replace_file(path, b"old", mode=PRIVATE)
    assert path.stat().st_mode & 0o777 == PRIVATE
    monkeypatch.setattr(os, "fsync", _full)
    with pytest.raises(OSError, match="No space left") as refusal:
        replace_file(path, b"new", to_disk=True)
    assert is_disk_full(refusal.value)
    assert path.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [path]


def test_what_fails_meanwhile_keeps_the_old_content(tmp_path: Path) -> None:
    path = tmp_path / "a"
    replace_file(path, b"old")
    seen = b""
    with suppress(ZeroDivisionError), replacing_file(path, b"new"):
        seen = path.read_bytes()
        raise ZeroDivisionError
    assert seen == b"old"
    assert [(one.name, one.read_bytes()) for one in tmp_path.iterdir()] == [("a", b"old")]


def test_output_goes_where_a_link_leads_and_into_devices(tmp_path: Path) -> None:
    link, target = tmp_path / "link", tmp_path / "target"
    target.write_bytes(b"old")
    link.symlink_to(target)
    write_output(link, b"new")
    assert link.is_symlink()
    assert target.read_bytes() == b"new"
    write_output(Path("/dev/null"), b"gone")
    assert not Path("/dev/null").is_file()
    with pytest.raises(OSError, match="No space left"):
        write_output(Path("/dev/full"), b"x")


def test_a_cause_far_below_counts() -> None:
    def deep() -> None:
        try:
            _full()
        except OSError as error:
            raise ValueError("parsing failed") from error

    with pytest.raises(ValueError, match="parsing") as found:
        deep()
    assert is_disk_full(found.value)
    assert not is_disk_full(ValueError("disk full"))


@pytest.mark.parametrize(("name", "value"), [("sqlite_errorcode", 13), ("sqlstate", "53100")])
def test_databases_say_it_in_their_own_way(name: str, value: object) -> None:
    error = ValueError("INSERT INTO audit ...")
    error.__cause__ = ValueError("full")
    assert not is_disk_full(error)
    setattr(error.__cause__, name, value)
    assert is_disk_full(error)
