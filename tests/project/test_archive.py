"""Archives from outside: what is unsound is refused before it is believed (architecture, decision 16)."""

import io
import struct
import zipfile

import pytest
from archives import archive
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from project_strategies import projects

from tappet.project.errors import FolderFormatError
from tappet.project.folder import encode, read_zip, write_zip
from tappet.project.folder.archive import Limits, unpack
from tappet.project.model import Project
from tappet.project.new_project import new_project


def folder_archive(project: Project, prefix: str = "") -> bytes:
    return archive(*((prefix + path, content) for path, content in encode(project).items()))


@settings(suppress_health_check=[HealthCheck.too_slow], deadline=None, max_examples=30)
@given(projects(), st.dictionaries(st.sampled_from(["README.md", "docs/a.png", "x"]), st.binary(max_size=20)))
def test_export_and_import(project: Project, extra: dict[str, bytes]) -> None:
    project = Project(project.name, project.description, project.objects, extra)
    packed = write_zip(project)
    assert read_zip(packed) == project
    assert write_zip(project) == packed


def test_the_project_may_stand_in_a_folder_of_the_archive() -> None:
    project = new_project("Press")
    assert read_zip(folder_archive(project)) == project
    assert read_zip(folder_archive(project, "a/b/")) == project
    with_litter = archive(
        *((f"Press/{path}", content) for path, content in encode(project).items()),
        ("__MACOSX/Press/._index.json", b"\x00"),
    )
    assert read_zip(with_litter) == project
    assert zipfile.ZipFile(io.BytesIO(write_zip(project))).namelist()[0].startswith("Press/")


def link(name: str) -> zipfile.ZipInfo:
    info = zipfile.ZipInfo(name)
    info.external_attr = 0o120777 << 16
    return info


@pytest.mark.parametrize(
    ("packed", "message"),
    [
        (b"", "cannot be read as a zip file"),
        (b"PK\x05\x06" + b"\x00" * 18, "holds no tappet-project.json"),
        (b"no zip at all", "cannot be read as a zip file"),
        (archive(("a.txt", b"")), "holds no tappet-project.json"),
        (archive(("../a", b"")), "does not stay in the folder"),
        (archive(("a/../../b", b"")), "does not stay in the folder"),
        (archive(("/etc/passwd", b"")), "does not stay in the folder"),
        (archive(("a\\..\\b", b"")), "does not stay in the folder"),
        (archive(("a//b", b"")), "does not stay in the folder"),
        (archive(("C:/a", b"")), "begins with a drive"),
        (archive(("a\nb", b"")), "control characters"),
        (archive(("/".join("a" * 70), b"")), "path is too long"),
        (archive(("a" * 1100, b"")), "path is too long"),
        (archive((link("a"), b"/etc/passwd")), "is a link or device"),
        (archive(("a", b"1"), ("A", b"2")), "stands twice"),
        (archive(("a/b", b"1"), ("A/B", b"2")), "stands twice"),
        (archive(("a", b"1"), ("a/b", b"2")), "is a file and a folder"),
        (archive(("a", b"1"), method=zipfile.ZIP_BZIP2), "other than deflate"),
        (archive(("a", b"1"), method=zipfile.ZIP_LZMA), "other than deflate"),
    ],
)
def test_unsound_archives(packed: bytes, message: str) -> None:
    with pytest.raises(FolderFormatError, match=message):
        read_zip(packed)


def test_limits() -> None:
    with pytest.raises(FolderFormatError, match="more than 3 files"):
        unpack(archive(*((f"f{i}", b"") for i in range(4))), Limits(files=3))
    with pytest.raises(FolderFormatError, match="unpacks to more than"):
        unpack(archive(("a", bytes(range(256)) * 10)), Limits(file_bytes=1000))
    with pytest.raises(FolderFormatError, match="unpacks to more than"):
        unpack(archive(("a", b"x" * 600), ("b", b"y" * 600)), Limits(total_bytes=1000))
    with pytest.raises(FolderFormatError, match="packed more than 200 times"):
        unpack(archive(("a", b"\x00" * (5 << 20))))
    assert unpack(archive(("a", b"\x00" * (1 << 19)))) == {"a": b"\x00" * (1 << 19)}


def test_an_archive_that_lies_about_its_sizes() -> None:
    """The directory says 10 bytes, the content unpacks to 4 MiB."""
    packed = bytearray(archive(("a", b"\x00" * (4 << 20))))
    central = packed.index(b"PK\x01\x02")
    struct.pack_into("<I", packed, central + 24, 10)
    struct.pack_into("<I", packed, packed.index(b"PK\x03\x04") + 22, 10)
    with pytest.raises(FolderFormatError):
        unpack(bytes(packed))


def test_an_encrypted_archive() -> None:
    packed = bytearray(archive(("a", b"x")))
    for mark, offset in ((b"PK\x01\x02", 8), (b"PK\x03\x04", 6)):
        packed[packed.index(mark) + offset] |= 1
    with pytest.raises(FolderFormatError, match="is encrypted"):
        unpack(bytes(packed))


PACKED = folder_archive(new_project("Press"))


@settings(deadline=None)
@given(
    st.lists(st.tuples(st.integers(0, len(PACKED) - 1), st.integers(1, 255)), min_size=1, max_size=6),
    st.booleans(),
)
def test_damaged_archives_end_in_a_message(flips: list[tuple[int, int]], cut: bool) -> None:
    packed = bytearray(PACKED)
    for offset, bits in flips:
        packed[offset] ^= bits
    if cut:
        del packed[flips[0][0] :]
    try:
        read = read_zip(bytes(packed))
    except FolderFormatError:
        return
    assert encode(read)


@settings(deadline=None)
@given(st.binary(max_size=300))
def test_any_bytes_end_in_a_message(noise: bytes) -> None:
    with pytest.raises(FolderFormatError):
        read_zip(noise)
