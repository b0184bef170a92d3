"""What one runtime process leaves for the next: which application it had, and the signal that ended it.

The file exists while an application is loaded and goes when the process ends properly. Its first page is
mapped: the signal handler (executive/crash.st) stores there what happened. So a program that takes the
process down is known after the restart, and is not started again by itself; docs/memory.md tells more.
"""

from __future__ import annotations

import os
import signal
import time
from dataclasses import dataclass
from pathlib import Path

import msgspec

from tappet.codegen.faults import Fault, fault_message
from tappet.codegen.package import CodePackage
from tappet.runtime.application import LoadedApplication
from tappet.runtime.exception_report import CallFrame, ExceptionReport
from tappet.runtime.executive.loader import Executive
from tappet.runtime.executive.records import Block, Record
from tappet.runtime.faults import NOT_TOLD, RawFault
from tappet.runtime.link import LinkedCode
from tappet.runtime.logbook import Logbook
from tappet.runtime.posix import PAGE, Mapping, map_memory, write_memory
from tappet.runtime.reports import stack_of

FILE = "running"
STABLE_S = 30.0
"""An application that has run so long since the process began did not end it by being started."""
MOST_STARTS = 2
"""So many starts from boot in a row may end without a word (killed, no power) before the next one waits."""


class Kept(msgspec.Struct):
    """What stands in the file behind the page of the handler."""

    application: str
    code_id: str
    starts: int = 0
    """Starts from boot in a row that did not become stable, this one included."""
    linked: bool = False
    tasks: list[str] = []
    contexts: list[int] = []
    """Addresses of the task contexts."""
    sections: list[tuple[int, int, int, int]] = []
    """Of the code: number of the object, section, address, size."""


@dataclass(frozen=True, slots=True)
class Crash:
    """How the last process ended that did not end properly."""

    kept: Kept
    signal: int
    """0: nothing is known, as after SIGKILL or without power."""
    address: int
    task: str
    fault: RawFault

    @property
    def reason(self) -> str:
        """In words."""
        if not self.signal:
            return (
                f"{self.kept.starts} starts in a row ended without a reason that is known (killed, no power)"
            )
        try:
            name = signal.Signals(self.signal).name
        except ValueError:
            name = f"signal {self.signal}"
        return f"the runtime process was ended by {name}"

    def concerns(self, package: CodePackage, log: Logbook) -> bool:
        """Whether it was this application; notes in any case how the last process ended."""
        if self.kept.code_id == package.code_id:
            if not self.waits:
                text = "the last runtime process ended without stopping it (killed, no power)"
                log.add("warning", "boot", f"{package.application}: {text}; it is started again")
            return True
        other = f"{self.kept.application}, downloaded last, is not the boot application: {self.reason}"
        log.add("error", "boot", other)
        return False

    @property
    def waits(self) -> bool:
        """Whether the application is not to be started by itself."""
        return self.signal != 0 or self.kept.starts >= MOST_STARTS

    def report(self, application: LoadedApplication, log: Logbook) -> ExceptionReport:
        """The exception of the application, which is loaded again but has not run."""
        fault = self._moved(application.code)
        code, stack = Fault.PROCESS_ENDED, stack_of(application, fault, log)
        here = stack[0] if stack else CallFrame("", "", 0)
        values = {"signal": self.reason.rpartition(" ")[2]} if self.signal else {}
        if self.signal and self.address not in (0, NOT_TOLD):
            values["address"] = f"16#{self.address:X}"
        return ExceptionReport(
            code, code.name, fault_message(code, reason=self.reason),
            self.task, here.pou, here.uri, here.line, self.fault.cycle, time.time_ns(), tuple(stack), values,
            here.place,
        )  # fmt: skip

    def _moved(self, code: LinkedCode) -> RawFault:
        """The fault with the addresses that its code has now."""
        bases = {(s.object_index, s.section): s.base for s in code.sections}

        def moved(address: int) -> int:
            for index, section, base, size in self.kept.sections:
                if base <= address <= base + size:
                    return bases.get((index, section), base) + address - base
            return 0

        fault = self.fault
        frames = tuple(moved(frame) for frame in fault.frames)
        return fault.at(moved(fault.pc), moved(fault.stack_top), frames)


class RunningMark:
    """The file of this process. Without folder there is none, and nothing is kept."""

    def __init__(self, executive: Executive, folder: Path | None, log: Logbook) -> None:
        self._executive = executive
        self._log = log
        self._path = folder / FILE if folder is not None else None
        self._layout = executive.layouts["CRASH_RECORD"]
        self._mapping: Mapping | None = None
        self._kept: Kept | None = None
        self._begun = 0.0

    def found(self) -> Crash | None:
        """What the process before has left; None when it ended properly, or the file is none of ours."""
        if self._path is None:
            return None
        try:
            data = self._path.read_bytes()
            kept = msgspec.msgpack.decode(data[PAGE:], type=Kept)
        except (OSError, msgspec.MsgspecError, UnicodeDecodeError):
            return None
        block = Block(PAGE)
        write_memory(block.address, data[:PAGE])
        record = Record(self._layout, block.address)
        context = record["pTask"]
        task = ""
        if context:
            known = context in kept.contexts
            task = kept.tasks[kept.contexts.index(context)] if known else "initialisation"
        part = record.part("fault", self._executive.layouts["FAULT_RECORD"])
        at = self._layout.members["fault"].offset + part.layout.members["frames"].offset
        fault = RawFault.read(part, data[at : at + part.size_of("frames")])
        if not fault.code:
            fault = fault.at(record["pc"], 0, ())
        return Crash(kept, record["signal"], record["address"], task, fault)

    def begin(self, package: CodePackage, starts: int = 0) -> None:
        """An application is going to be loaded or initialised."""
        self._release()
        self._write(Kept(package.application, package.code_id, starts))
        self._begun = time.monotonic()

    def linked(self, application: LoadedApplication) -> None:
        """The code of the application lies where it does now."""
        if self._kept is None:
            return
        self._write(
            msgspec.structs.replace(
                self._kept,
                application=application.package.application,
                code_id=application.package.code_id,
                linked=True,
                tasks=[t.name for t in application.package.tasks],
                contexts=[t.address for t in application.contexts.tasks],
                sections=[(s.object_index, s.section, s.base, s.size) for s in application.code.sections],
            )
        )

    def look(self) -> None:
        """Called now and then while the application runs: after a while its start has gone well."""
        if self._kept is not None and self._kept.starts and time.monotonic() - self._begun > STABLE_S:
            self.settle()

    def settle(self) -> None:
        """The start has gone well, or the application was stopped."""
        if self._kept is not None and self._kept.starts:
            self._write(msgspec.structs.replace(self._kept, starts=0))

    def _write(self, kept: Kept) -> None:
        self._kept = kept
        if self._path is None:
            return
        try:
            self._write_file(self._path, msgspec.msgpack.encode(kept))
        except OSError as error:
            text = f"if the application ends this process, the next one will not know: {error}"
            self._log.add("error", "boot", text)

    def _write_file(self, path: Path, data: bytes) -> None:
        fd = os.open(path, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)
        try:
            if self._mapping is None:
                os.ftruncate(fd, 0)
                os.pwrite(fd, bytes(PAGE), 0)  # a page without room on the disk would end the process
                self._mapping = map_memory(PAGE, fd)
                self._executive.store(self._executive.registry.place("pCrash"), self._mapping.address)
            os.pwrite(fd, data, PAGE)
            os.ftruncate(fd, PAGE + len(data))
            os.fsync(fd)
        finally:
            os.close(fd)

    def end(self) -> None:
        """The application is gone, properly."""
        self._release()
        if self._path is not None:
            self._path.unlink(missing_ok=True)
        self._kept = None

    def _release(self) -> None:
        if self._mapping is not None:
            self._executive.store(self._executive.registry.place("pCrash"), 0)
            self._mapping.close()
            self._mapping = None
