"""Code packages that were downloaded: online changes start from them, also after a restart of the server."""

from __future__ import annotations

import re
from contextlib import suppress
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

from tappet.codegen.package import CodePackage, PackageError
from tappet.project.errors import ProjectError
from tappet.project.folder import read_zip, write_zip
from tappet.project.model import Project
from tappet.whole_file import PRIVATE, replace_file

KEEP = 10
"""Newest packages of one application that are kept."""
SOURCE = ".source"
"""Ending of the archive of the project that a package was built from, beside it."""
_ID = re.compile(r"[0-9A-Za-z_-]{1,128}")


@dataclass(frozen=True, slots=True)
class StoredPackage:
    """A package and the application it was built from."""

    project_id: str
    application_id: str
    code_id: str
    data: bytes


class PackageStore:
    """Files named `<project>.<application>.<code>.package`, with their sources. All methods block."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def put(self, project_id: str, application_id: str, code_id: str, data: bytes) -> None:
        """Keeps a package; the oldest ones of the application go."""
        self._folder.mkdir(parents=True, exist_ok=True, mode=0o700)
        path = self._folder / f"{_safe(project_id)}.{_safe(application_id)}.{_safe(code_id)}.package"
        replace_file(path, data, mode=PRIVATE, to_disk=True)
        for old in self._newest_first(f"{project_id}.{application_id}.*.package")[KEEP:]:
            old.unlink(missing_ok=True)
            old.with_suffix(SOURCE).unlink(missing_ok=True)

    def put_source(self, project_id: str, application_id: str, code_id: str, project: Project) -> None:
        """Keeps the project that a package was built from, as long as the package is kept."""
        path = self._folder / f"{_safe(project_id)}.{_safe(application_id)}.{_safe(code_id)}{SOURCE}"
        self._folder.mkdir(parents=True, exist_ok=True, mode=0o700)
        replace_file(path, write_zip(project), mode=PRIVATE)

    def source(self, code_id: str) -> tuple[Project, datetime] | None:
        """The project that this code was built from, and when it was downloaded."""
        if not _ID.fullmatch(code_id):
            return None
        for path in self._newest_first(f"*.*.{code_id}{SOURCE}"):
            with suppress(OSError, ProjectError):  # damaged, or just gone: as good as none
                at = datetime.fromtimestamp(path.stat().st_mtime, UTC)
                return read_zip(path.read_bytes()), at
        return None

    def has_source(self, code_id: str) -> bool:
        """Whether the project that this code was built from is kept."""
        return bool(_ID.fullmatch(code_id)) and any(self._folder.glob(f"*.*.{code_id}{SOURCE}"))

    def find(self, code_id: str) -> StoredPackage | None:
        """The package with this code, whatever application it was built from."""
        if not _ID.fullmatch(code_id):
            return None
        return self._read_first(f"*.*.{code_id}.package")

    def latest(self, project_id: str, application_id: str) -> StoredPackage | None:
        """The package of an application that was downloaded last."""
        return self._read_first(f"{_safe(project_id)}.{_safe(application_id)}.*.package")

    def remove(self, project_id: str, application_id: str) -> None:
        """Forget all packages of an application and their sources: the next login finds it in no runtime as
        one of ours.
        """
        for path in self._folder.glob(f"{_safe(project_id)}.{_safe(application_id)}.*"):
            path.unlink(missing_ok=True)

    def _read_first(self, pattern: str) -> StoredPackage | None:
        for path in self._newest_first(pattern):
            project_id, application_id, code_id, _ = path.name.split(".")
            try:
                data = path.read_bytes()
                CodePackage.from_bytes(data)
            except (OSError, PackageError):
                continue  # of an older version, or damaged: as good as none
            return StoredPackage(project_id, application_id, code_id, data)
        return None

    def _newest_first(self, pattern: str) -> list[Path]:
        found = [(path.stat().st_mtime_ns, path) for path in self._folder.glob(pattern)]
        return [path for _, path in sorted(found, reverse=True)]


def _safe(id: str) -> str:
    if not _ID.fullmatch(id):
        raise ValueError(f"'{id}' is no id")
    return id
