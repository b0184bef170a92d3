"""The system calls the runtime needs and Python does not offer: low memory, native threads, signals,
scheduling.
"""

from __future__ import annotations

import ctypes
import errno
import mmap
import os
import platform
import time
from ctypes import c_char_p, c_int, c_int64, c_long, c_size_t, c_uint64, c_void_p
from dataclasses import dataclass

libc = ctypes.CDLL(None, use_errno=True)
libm = ctypes.CDLL("libm.so.6")

PAGE = mmap.PAGESIZE
LOW_LIMIT = 1 << 32
"""Application data lie below this address, as CODESYS-style code keeps pointers in DWORD (decision 12)."""

_MAP_32BIT, _MAP_FIXED = 0x40, 0x10
_MAP_FIXED_NOREPLACE = 0x100000
_MAP_FAILED = (1 << 64) - 1
_HINT_STEP = 16 << 20

SCHED_FIFO = 1
SCHED_RR = 2
WATCHDOG_SIGNAL = 42
"""A real-time signal that nobody else uses; it makes a task thread look at its watchdog."""
FAULT_SIGNALS = (4, 7, 8, 11)  # SIGILL, SIGBUS, SIGFPE, SIGSEGV
ABORT_SIGNAL = 6
_SA_SIGINFO, _SA_ONSTACK, _SA_NODEFER = 0x4, 0x08000000, 0x40000000
SIGACTION_SIZE = 152
_PRIO_INHERIT = 1
_RSEQ_SIZE = 32
"""Bytes that are registered at least; newer libraries say how many of them are in use."""
_WORD = (1 << 64) - 1
_MCL_CURRENT, _MCL_FUTURE, _MCL_ONFAULT = 1, 2, 4


def _declare(name: str, result: type | None, *arguments: type) -> None:
    function = getattr(libc, name)
    function.restype = result
    function.argtypes = arguments


_declare("mmap", c_uint64, c_uint64, c_size_t, c_int, c_int, c_int, c_long)
_declare("munmap", c_int, c_uint64, c_size_t)
_declare("mprotect", c_int, c_uint64, c_size_t, c_int)
_declare("msync", c_int, c_uint64, c_size_t, c_int)
_declare("mlockall", c_int, c_int)
_declare("pthread_attr_init", c_int, c_void_p)
_declare("pthread_attr_destroy", c_int, c_void_p)
_declare("pthread_attr_setstack", c_int, c_void_p, c_uint64, c_size_t)
_declare("pthread_attr_setschedpolicy", c_int, c_void_p, c_int)
_declare("pthread_attr_setschedparam", c_int, c_void_p, c_void_p)
_declare("pthread_attr_setinheritsched", c_int, c_void_p, c_int)
_declare("pthread_attr_setaffinity_np", c_int, c_void_p, c_size_t, c_void_p)
_declare("pthread_create", c_int, c_void_p, c_void_p, c_uint64, c_uint64)
_declare("pthread_clockjoin_np", c_int, c_uint64, c_void_p, c_int, c_void_p)
_declare("pthread_kill", c_int, c_uint64, c_int)
_declare("pthread_setname_np", c_int, c_uint64, c_char_p)
_declare("pthread_key_create", c_int, c_void_p, c_void_p)
_declare("sigaction", c_int, c_int, c_void_p, c_void_p)
_declare("pthread_mutexattr_init", c_int, c_void_p)
_declare("pthread_mutexattr_setprotocol", c_int, c_void_p, c_int)
_declare("pthread_mutexattr_destroy", c_int, c_void_p)
_declare("pthread_mutex_init", c_int, c_uint64, c_void_p)
_declare("sem_init", c_int, c_uint64, c_int, c_int)
_declare("sem_post", c_int, c_uint64)
_declare("sem_clockwait", c_int, c_uint64, c_int, c_void_p)


class Timespec(ctypes.Structure):
    """struct timespec."""

    _fields_ = (("seconds", c_int64), ("nanoseconds", c_int64))


@dataclass(frozen=True, slots=True)
class RegisterPlaces:
    """Byte offsets of the program counter, frame and stack pointer in ucontext_t (glibc)."""

    pc: int
    frame: int
    stack: int


_REGISTERS = {"x86_64": RegisterPlaces(168, 120, 160), "aarch64": RegisterPlaces(440, 416, 432)}
SIGNAL_ADDRESS_OFFSET = 16
"""si_addr in siginfo_t, on 64-bit Linux."""


def register_places() -> RegisterPlaces:
    """Where an interrupted thread's registers are; OSError on a host we do not know."""
    machine = platform.machine()
    try:
        return _REGISTERS[machine]
    except KeyError:
        raise OSError(
            f"the runtime does not support {machine} hosts; known are {', '.join(_REGISTERS)}"
        ) from None


def _error(what: str, number: int | None = None) -> OSError:
    code = ctypes.get_errno() if number is None else number
    return OSError(code, f"{what}: {os.strerror(code)}")


# -- memory -----------------------------------------------------------------------------------------


@dataclass(slots=True)
class Mapping:
    """A mapped range of memory; `low`: whether it lies below 4 GiB."""

    address: int
    size: int

    @property
    def low(self) -> bool:
        """Whether every byte is below 4 GiB."""
        return self.address + self.size <= LOW_LIMIT

    def protect(self, offset: int, size: int, *, accessible: bool) -> None:
        """Allow or forbid access to a page-aligned part."""
        flags = mmap.PROT_READ | mmap.PROT_WRITE if accessible else 0
        if libc.mprotect(self.address + offset, size, flags):
            raise _error("mprotect")

    def clear(self, offset: int, size: int) -> None:
        """Replace a page-aligned part of an anonymous mapping by fresh zeroed memory, which takes no room."""
        flags = _MAP_FIXED | mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS
        place = self.address + offset
        if libc.mmap(place, size, mmap.PROT_READ | mmap.PROT_WRITE, flags, -1, 0) != place:
            raise _error(f"cannot map {size} bytes")

    def sync(self) -> None:
        """Write a shared file mapping back to its file (blocks; never call it from a task)."""
        if libc.msync(self.address, self.size, 4):
            raise _error("msync")

    def close(self) -> None:
        """Unmap; nothing may use the addresses any more."""
        if self.size:
            libc.munmap(self.address, self.size)
            self.size = 0


def pages(size: int) -> int:
    """`size` rounded up to whole pages, at least one."""
    return max(1, -(-size // PAGE)) * PAGE


def map_memory(size: int, fd: int = -1, *, low: bool = False, at: int = 0) -> Mapping:
    """Map `size` bytes, of the file `fd` (shared) or anonymous (private).

    `low` asks for addresses below 4 GiB: first by MAP_32BIT (x86-64), then by trying free places. Where the
    host has none the mapping lies anywhere; the caller looks at `Mapping.low` and says so. `at` is tried
    before all others.
    """
    size = pages(size)
    protection = mmap.PROT_READ | mmap.PROT_WRITE
    flags = mmap.MAP_SHARED if fd >= 0 else mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS
    if at:
        address = libc.mmap(at, size, protection, flags | _MAP_FIXED_NOREPLACE, fd, 0)
        if address == at:
            return Mapping(address, size)
        if address != _MAP_FAILED:
            libc.munmap(address, size)
    if low and platform.machine() == "x86_64":
        address = libc.mmap(0, size, protection, flags | _MAP_32BIT, fd, 0)
        if address != _MAP_FAILED:
            return Mapping(address, size)
    if low:
        for hint in range(_HINT_STEP, LOW_LIMIT - size, _HINT_STEP):
            address = libc.mmap(hint, size, protection, flags | _MAP_FIXED_NOREPLACE, fd, 0)
            if address == hint:
                return Mapping(address, size)
            if address != _MAP_FAILED:  # a kernel that does not know the flag takes the hint as a wish
                libc.munmap(address, size)
    address = libc.mmap(0, size, protection, flags, fd, 0)
    if address == _MAP_FAILED:
        raise _error(f"cannot map {size} bytes")
    return Mapping(address, size)


def read_memory(address: int, size: int) -> bytes:
    """Copy of mapped memory."""
    return ctypes.string_at(address, size)


def write_memory(address: int, data: bytes) -> None:
    """Store bytes into mapped memory."""
    ctypes.memmove(address, data, len(data))


def lock_memory() -> str | None:
    """Keep touched pages in RAM, so that no cycle waits for a disk; None, or why it is not permitted."""
    if libc.mlockall(_MCL_CURRENT | _MCL_FUTURE | _MCL_ONFAULT) == 0:
        return None
    return os.strerror(ctypes.get_errno())


# -- threads ----------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class ThreadOptions:
    """How a native thread runs; `fifo` is the SCHED_FIFO priority, None for normal scheduling."""

    name: str
    fifo: int | None = None
    cpus: frozenset[int] | None = None
    round_robin: bool = False
    """SCHED_RR instead of SCHED_FIFO."""


def create_thread(entry: int, argument: int, stack: Mapping, guard: int, options: ThreadOptions) -> int:
    """Start `entry(argument)` on the given stack, whose first `guard` bytes are guard pages; pthread_t.

    Raises PermissionError when the host does not permit the real-time priority.
    """
    attributes = ctypes.create_string_buffer(64)
    libc.pthread_attr_init(attributes)
    try:
        libc.pthread_attr_setstack(attributes, stack.address + guard, stack.size - guard)
        if options.fifo is not None:
            libc.pthread_attr_setinheritsched(attributes, 1)
            libc.pthread_attr_setschedpolicy(attributes, SCHED_RR if options.round_robin else SCHED_FIFO)
            libc.pthread_attr_setschedparam(attributes, ctypes.byref(c_int(options.fifo)))
        if options.cpus is not None:
            words = (c_uint64 * 16)()
            for cpu in options.cpus:
                words[cpu // 64] |= 1 << cpu % 64
            libc.pthread_attr_setaffinity_np(attributes, ctypes.sizeof(words), words)
        thread = c_uint64()
        status = libc.pthread_create(ctypes.byref(thread), attributes, entry, argument)
    finally:
        libc.pthread_attr_destroy(attributes)
    if status:
        raise _error(f"cannot start thread {options.name}", status)
    libc.pthread_setname_np(thread, options.name.encode("ascii", "replace")[:15])
    return thread.value


def join_thread(thread: int, timeout_s: float) -> bool:
    """Wait for the end of a native thread without holding the GIL; False when it still runs."""
    limit = _moment(timeout_s)
    status = libc.pthread_clockjoin_np(thread, None, time.CLOCK_MONOTONIC, ctypes.byref(limit))
    if status == 0:
        return True
    if status == errno.ETIMEDOUT:
        return False
    raise _error("pthread_clockjoin_np", status)


def take_semaphore(address: int, timeout_s: float) -> bool:
    """Wait for a post of a semaphore without holding the GIL; False when none has come."""
    limit = _moment(timeout_s)
    if libc.sem_clockwait(address, time.CLOCK_MONOTONIC, ctypes.byref(limit)) == 0:
        return True
    if ctypes.get_errno() in (errno.ETIMEDOUT, errno.EINTR):
        return False
    raise _error("sem_clockwait")


def _moment(after_s: float) -> Timespec:
    """On the monotonic clock."""
    due = time.clock_gettime_ns(time.CLOCK_MONOTONIC) + int(after_s * 1e9)
    return Timespec(due // 1_000_000_000, due % 1_000_000_000)


def signal_thread(thread: int, signal: int) -> None:
    """Send a signal to a native thread that has not been joined."""
    libc.pthread_kill(thread, signal)


def create_mutex(address: int) -> None:
    """Make a mutex at `address` (40 bytes); who holds it runs at the priority of the highest that waits."""
    attributes = ctypes.create_string_buffer(16)
    libc.pthread_mutexattr_init(attributes)
    try:
        libc.pthread_mutexattr_setprotocol(attributes, _PRIO_INHERIT)
        status = libc.pthread_mutex_init(address, attributes)
    finally:
        libc.pthread_mutexattr_destroy(attributes)
    if status:
        raise _error("pthread_mutex_init", status)


def create_thread_key() -> int:
    """A new key of thread-specific data."""
    key = c_int()
    status = libc.pthread_key_create(ctypes.byref(key), None)
    if status:
        raise _error("pthread_key_create", status)
    return key.value


def install_handler(signal: int, handler: int, previous: int, *, unmasked: bool) -> None:
    """Make the native function at `handler` handle `signal`; the action before is stored at `previous`.

    `unmasked` lets the signal come again while its handler runs (it may leave by a jump).
    """
    action = ctypes.create_string_buffer(SIGACTION_SIZE)
    ctypes.c_uint64.from_buffer(action, 0).value = handler
    ctypes.c_int.from_buffer(action, 136).value = _SA_SIGINFO | _SA_ONSTACK
    if unmasked:
        ctypes.c_int.from_buffer(action, 136).value |= _SA_NODEFER
    if libc.sigaction(signal, action, c_void_p(previous)):
        raise _error(f"sigaction({signal})")


def restartable_sequences() -> tuple[int, int]:
    """What the C library registers of each thread with rseq(2): offset from pthread_self, and size.

    (0, 0) where it registers nothing, or pthread_self is not what the offset counts from.
    """
    if platform.machine() != "x86_64":
        return 0, 0
    try:
        size = ctypes.c_uint.in_dll(libc, "__rseq_size").value
        offset = ctypes.c_ssize_t.in_dll(libc, "__rseq_offset").value
    except ValueError:
        return 0, 0
    return (offset & _WORD, max(size, _RSEQ_SIZE)) if size else (0, 0)


def symbol_address(name: str) -> int:
    """Address of a function of the C or mathematics library; 0 when there is none."""
    for library in (libm, libc):
        try:
            return ctypes.cast(getattr(library, name), c_void_p).value or 0
        except AttributeError:
            continue
    return 0
