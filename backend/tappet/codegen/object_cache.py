"""Compiled objects by content, in memory and on disk. LLVM is loaded to compile only."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path

import llvmlite

from tappet.codegen.compile_options import FLAGS, OptimiseOptions
from tappet.whole_file import PRIVATE, replace_file


class ObjectCache:
    """Objects on disk under the hash of text, options and LLVM version; safe for many processes."""

    def __init__(self, folder: Path | None, limit: int = 512 << 20) -> None:
        self.folder = folder
        self.limit = limit
        self.memory: dict[str, bytes] = {}
        """Objects of the builds of this process since the last `forget`."""
        self.hits = 0
        self._trimmed = False

    def key(self, text: str, options: OptimiseOptions) -> str:
        """Content hash of one compilation."""
        digest = hashlib.blake2b(digest_size=20)
        digest.update(f"{llvmlite.__version__}|{options}|{FLAGS}|".encode())
        digest.update(text.encode())
        return digest.hexdigest()

    def compile(self, text: str, options: OptimiseOptions) -> bytes:
        """Object from the cache, or compiled and stored."""
        name = self.key(text, options)
        data = self.read(name)
        if data is not None:
            self.hits += 1
            return data
        from tappet.codegen.optimise import compile_text

        data = compile_text(text, options)
        self.write(name, data)
        return data

    def read(self, name: str) -> bytes | None:
        """A stored object; damaged ones count as missing."""
        kept = self.memory.get(name)
        if kept is not None or self.folder is None:
            return kept
        try:
            data = (self.folder / name[:2] / name).read_bytes()
        except OSError:
            return None
        check, data = data[:16], data[16:]
        return data if hashlib.blake2b(data, digest_size=16).digest() == check else None

    def write(self, name: str, data: bytes) -> None:
        """Store an object; a full or read-only disk is no error."""
        self.memory[name] = data
        if self.folder is None:
            return
        if not self._trimmed:  # who only reads does not look through the folder
            self._trimmed = True
            self.trim()
        folder = self.folder / name[:2]
        with suppress(OSError):
            self.folder.mkdir(parents=True, exist_ok=True, mode=0o700)
            folder.mkdir(exist_ok=True, mode=0o700)
            replace_file(folder / name, hashlib.blake2b(data, digest_size=16).digest() + data, mode=PRIVATE)

    def forget(self, keep: Iterable[str]) -> None:
        """Drop the objects in memory that are not in `keep`."""
        names = set(keep)
        self.memory = {name: data for name, data in self.memory.items() if name in names}

    def trim(self) -> None:
        """Remove the oldest objects until the folder fits its limit; other processes may do so too."""
        files = []
        for file in self.folder.glob("??/*") if self.folder is not None else ():
            with suppress(OSError):
                found = file.stat()
                files.append((found.st_mtime, found.st_size, file))
        total = sum(size for _, size, _ in files)
        for _, size, file in sorted(files):
            if total <= self.limit:
                break
            with suppress(OSError):
                file.unlink()
            total -= size
