"""LLVM text to optimised ELF objects, with a cache on disk keyed by content."""

from __future__ import annotations

import hashlib
import os
import tempfile
import threading
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import llvmlite
import llvmlite.binding as llvm

CPU = "x86-64-v2"
"""Oldest processor that packages run on: SSE4.2 and POPCNT, as every x86-64 industrial PC since 2009 has."""

FLAGS = (
    # A frame set up only on some paths would hide the caller of a faulting leaf from the call stack.
    "-enable-shrink-wrap=false",
    # A 32-bit load of a 16-bit variable just stored waits for the store to reach the cache: some 12 cycles.
    "-x86-promote-anyext-load=false",
)
"""Options of the LLVM library."""


@dataclass(frozen=True, slots=True)
class OptimiseOptions:
    """How hard to try."""

    level: int = 2
    """0..3 as in -O."""
    cpu: str = CPU
    triple: str = "x86_64-unknown-linux-gnu"


class LlvmError(RuntimeError):
    """LLVM refused the text the compiler produced: an error of the compiler, not of the program."""


_lock = threading.Lock()
_ready = False


def initialise() -> None:
    """Start LLVM once per process."""
    global _ready  # process-wide state of the LLVM library
    with _lock:
        if _ready:
            return
        llvm.initialize_native_target()
        llvm.initialize_native_asmprinter()
        for flag in FLAGS:
            llvm.set_option("tappet", flag)
        _ready = True


def target_machine(options: OptimiseOptions) -> llvm.TargetMachine:
    """Target machine for position independent code."""
    initialise()
    target = llvm.Target.from_triple(options.triple)
    return target.create_target_machine(
        cpu=options.cpu, opt=min(options.level, 2), reloc="pic", codemodel="small"
    )


def compile_text(text: str, options: OptimiseOptions) -> bytes:
    """ELF object of an LLVM module given as text."""
    machine = target_machine(options)
    module = _optimised(text, options, machine)
    return bytes(machine.emit_object(module))


def _optimised(text: str, options: OptimiseOptions, machine: llvm.TargetMachine) -> llvm.ModuleRef:
    try:
        module = llvm.parse_assembly(text, llvm.create_context())
    except RuntimeError as error:
        raise LlvmError(str(error)) from error
    tuning = llvm.create_pipeline_tuning_options(speed_level=options.level)
    tuning.loop_vectorization = options.level >= 2
    tuning.slp_vectorization = options.level >= 2
    builder = llvm.create_pass_builder(machine, tuning)
    manager = builder.getModulePassManager()
    manager.run(module, builder)
    _free(manager)
    return module


def _free(manager: llvm.ModulePassManager) -> None:
    """Give a pass manager back: llvmlite 0.50 overrides its own disposal, and 50 KiB a build would stay."""
    if type(manager).__dict__.get("_dispose") is None:
        llvm.newpassmanagers.NewPassManager._dispose(manager)
        manager.detach()


class ObjectCache:
    """Objects on disk under the hash of text, options and LLVM version; safe for many processes."""

    def __init__(self, folder: Path | None, limit: int = 512 << 20) -> None:
        self.folder = folder
        self.limit = limit
        self.memory: dict[str, bytes] = {}
        """Objects of the builds of this process since the last `forget`."""
        self.hits = 0

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
        folder = self.folder / name[:2]
        try:
            folder.mkdir(parents=True, exist_ok=True)
            handle, temporary = tempfile.mkstemp(dir=folder)
            with os.fdopen(handle, "wb") as file:
                file.write(hashlib.blake2b(data, digest_size=16).digest() + data)
            os.replace(temporary, folder / name)
        except OSError:
            return

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
