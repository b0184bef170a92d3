"""Libraries as files: one `.tappetlib` (a zip of `library.json` and `.st` files), or a folder of the same.

What comes from outside is checked for its count, sizes and paths before anything is written.
"""

from __future__ import annotations

import io
import json
import re
import shutil
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from tappet.libraries import repository
from tappet.libraries.repository import Installed
from tappet.project.errors import FolderFormatError

SUFFIX = ".tappetlib"
MANIFEST = "library.json"
MAX_FILES = 10_000
MAX_BYTES = 64 * 1024 * 1024
"""Of all files together, unpacked."""
_FILE = re.compile(r"^[A-Za-z_][A-Za-z0-9_]{0,127}\.st$")
_NAME = re.compile(r"^[A-Za-z_][A-Za-z0-9_. -]{0,79}$")
_VERSION = re.compile(r"^[0-9]+(\.[0-9]+){0,3}$")
_STAMP = (1980, 1, 1, 0, 0, 0)
"""Time of the files in an archive, so that equal libraries are equal files."""


class LibraryFileError(ValueError):
    """A library file or folder is not what it should be; the message says what would be right."""


def manifest(
    name: str,
    version: str,
    *,
    namespace: str = "",
    company: str = "",
    description: str = "",
    requires: list[dict[str, Any]] | None = None,
    qualified_only: bool = False,
) -> dict[str, Any]:
    """The content of `library.json`; raises LibraryFileError for a name or version that cannot be one."""
    facts: dict[str, Any] = {
        "company": company,
        "description": description,
        "name": name,
        "namespace": namespace or re.sub(r"\W+", "_", name),
        "requires": requires or [],
        "version": version,
    }
    if qualified_only:
        facts["qualified_only"] = True
    _check_manifest(facts)
    return facts


def pack(facts: Mapping[str, Any], texts: Mapping[str, str]) -> bytes:
    """A library file of `library.json` and texts by name without `.st`; equal content gives equal bytes."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        content = {MANIFEST: _manifest_text(facts)}
        content |= {f"{name}.st": text for name, text in texts.items()}
        for file, text in sorted(content.items()):
            archive.writestr(zipfile.ZipInfo(file, _STAMP), text.encode("utf-8"), zipfile.ZIP_DEFLATED)
    return out.getvalue()


def unpack(data: bytes) -> tuple[dict[str, Any], dict[str, str]]:
    """Manifest and texts of a library file; raises LibraryFileError."""
    from tappet.project.folder.archive import Limits
    from tappet.project.folder.archive import unpack as unpack_zip

    limits = Limits(files=MAX_FILES, file_bytes=MAX_BYTES, total_bytes=MAX_BYTES)
    try:
        files = unpack_zip(data, limits)
    except FolderFormatError as error:
        raise LibraryFileError(f"this is no library file ({SUFFIX}): {error}") from None
    return _checked(files)


def read(path: Path) -> tuple[dict[str, Any], dict[str, str]]:
    """Manifest and texts of a library file or folder; raises LibraryFileError."""
    if path.is_dir():
        if not (path / MANIFEST).is_file():
            raise LibraryFileError(f"{path} is no library: it has no {MANIFEST}")
        found = [path / MANIFEST, *path.glob("*.st")]
        return _checked({file.name: file.read_bytes() for file in found})
    try:
        return unpack(path.read_bytes())
    except OSError as error:
        raise LibraryFileError(f"{path}: {error.strerror}") from None


def install(facts: Mapping[str, Any], texts: Mapping[str, str]) -> Installed:
    """Puts a library beside those that are there; one of the same name and version is replaced.

    Raises LibraryFileError when the product itself comes with this name and version.
    """
    _check_manifest(facts)
    name, version = str(facts["name"]), str(facts["version"])
    for known in repository.installed():
        same = (known.name.upper(), known.version) == (name.upper(), version)
        if same and not known.removable:
            raise LibraryFileError(
                f"'{name}' {version} comes with Tappet; give yours another name or version"
            )
    folder = repository.user_location() / name / version
    fresh = folder.with_name(f".{version}.new")
    shutil.rmtree(fresh, ignore_errors=True)
    fresh.mkdir(parents=True)
    try:
        for stem, text in texts.items():
            (fresh / f"{stem}.st").write_text(text, encoding="utf-8")
        (fresh / MANIFEST).write_text(_manifest_text(facts), encoding="utf-8")
        shutil.rmtree(folder, ignore_errors=True)
        fresh.rename(folder)
    except OSError:
        shutil.rmtree(fresh, ignore_errors=True)
        raise
    return repository.find(name, version)


def remove(name: str, version: str) -> None:
    """Uninstalls one version; raises UnknownLibraryError, or LibraryFileError for those of the product."""
    found = repository.find(name, version)
    if not found.removable:
        raise LibraryFileError(f"'{found.name}' {found.version} comes with Tappet and stays")
    shutil.rmtree(found.folder)
    if not any(found.folder.parent.iterdir()):
        found.folder.parent.rmdir()


def _manifest_text(facts: Mapping[str, Any]) -> str:
    return json.dumps(facts, indent=2, sort_keys=True, ensure_ascii=False) + "\n"


def _checked(files: Mapping[str, bytes]) -> tuple[dict[str, Any], dict[str, str]]:
    if MANIFEST not in files:
        raise LibraryFileError(f"the library has no {MANIFEST}")
    try:
        facts = json.loads(files[MANIFEST].decode("utf-8"))
    except (UnicodeDecodeError, ValueError) as error:
        raise LibraryFileError(f"{MANIFEST}: {error}") from None
    if not isinstance(facts, dict):
        raise LibraryFileError(f"{MANIFEST} holds no object")
    _check_manifest(facts)
    texts = {}
    for file, data in files.items():
        if file == MANIFEST:
            continue
        if not _FILE.match(file):
            raise LibraryFileError(f"'{file}' is no ST file of a library: names look like FB_Motor.st")
        try:
            texts[file.removesuffix(".st")] = data.decode("utf-8")
        except UnicodeDecodeError as error:
            raise LibraryFileError(f"{file} is not UTF-8: {error}") from None
    return facts, texts


def _check_manifest(facts: Mapping[str, Any]) -> None:
    name, version = facts.get("name"), facts.get("version")
    if not isinstance(name, str) or not _NAME.match(name) or ".." in name:
        raise LibraryFileError(
            f"the name {name!r} is none for a library; letters, digits, _ - . and spaces are"
        )
    if not isinstance(version, str) or not _VERSION.match(version):
        raise LibraryFileError(f"the version {version!r} is none; write it like 1.2.0.0")
    namespace = facts.get("namespace", "")
    if not isinstance(namespace, str) or (namespace and not namespace.isidentifier()):
        raise LibraryFileError(f"the namespace {namespace!r} is no identifier")
    for key in ("company", "description"):
        if not isinstance(facts.get(key, ""), str):
            raise LibraryFileError(f"'{key}' has to be a text")
    _check_qualified_only(facts)
    requires = facts.get("requires", [])
    if not isinstance(requires, list) or not all(isinstance(r, dict) and "name" in r for r in requires):
        raise LibraryFileError("'requires' has to be a list of objects with a name")
    for required in requires:
        _check_parameters(required.get("parameters", []))
        _check_qualified_only(required)


def _check_qualified_only(facts: Mapping[str, Any]) -> None:
    if not isinstance(facts.get("qualified_only", False), bool):
        raise LibraryFileError("'qualified_only' has to be true or false")


def _check_parameters(parameters: object) -> None:
    """The values that a library asks for in one that it needs."""
    if not isinstance(parameters, list) or not all(
        isinstance(one, dict) and isinstance(one.get("name"), str) and isinstance(one.get("value"), str)
        for one in parameters
    ):
        raise LibraryFileError("'parameters' of 'requires' has to be a list of objects with name and value")
