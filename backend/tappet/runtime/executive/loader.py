"""Builds the executive from its ST sources, links it once per process and installs its signal handlers."""

from __future__ import annotations

import ctypes
import hashlib
import json
import threading
from collections.abc import Mapping
from pathlib import Path

import llvmlite

from tappet.codegen.object_cache import ObjectCache
from tappet.lang.source import Scope, Source
from tappet.runtime import posix
from tappet.runtime.executive.records import Block, Layout, MemberPlace, Record
from tappet.runtime.link import LinkedCode, Linker
from tappet.user_cache import cache_folder, compiler_stamp

FOLDER = Path(__file__).parent

STRUCTURES = (
    "VALUE_ITEM", "VALUE_LIST", "WRITE_QUEUE", "IO_RANGE", "IO_LIST", "MEMORY_RANGE", "RECORDER",
    "RECORDER_LIST", "FLIGHT_ENTRY", "FLIGHT_RECORDER", "RETAIN_SLOT", "RETAIN_GROUP", "FAULT_RECORD",
    "TASK_STATISTICS", "WATCHDOG_STATE", "TASK_CONTEXT", "APPLICATION_CONTEXT", "THREAD_ENTRY",
    "EXECUTIVE_REGISTRY", "LOG_MESSAGE", "LOG_RING", "FILE_STORE", "DESCRIPTION",
    "EXPRESSION_STEP", "EXPRESSION", "EXPRESSION_MEMORY", "TRACE_EXPRESSION", "TRACE_RECORD", "TRACE_LIST",
    "DESCRIBED_TYPE", "DESCRIBED_MEMBER", "DESCRIBED_ROOT", "HEAP_ARENA", "HEAP_BLOCK", "CRASH_RECORD",
    "DEBUG_FRAME", "BREAKPOINT", "DATA_BREAKPOINT", "BREAKPOINT_TABLE", "DEBUG_CONTEXT", "DEBUG_TASK",
    "DEBUG_LOG", "DEBUG_LOG_ENTRY", "FLOW_TABLE", "FLOW_RESULT",
)  # fmt: skip
"""Structures of types.st that Python fills or reads."""

ENTRIES = (
    "tappet_task_thread", "tappet_scheduler_thread", "tappet_virtual_thread", "tappet_call_thread",
    "tappet_signal", "tappet_apply_values", "tappet_save_retain", "tappet_store", "tappet_store_flag",
    "tappet_load", "tappet_file_thread", "tappet_files_reset",
    "tappet_files_sweep", "tappet_heap_begin", "tappet_heap_check", "tappet_evaluate",
)  # fmt: skip
"""What Python starts or calls."""

FILE_SERVICES = (
    "tappet_file", "tappet_file_post", "tappet_file_poll", "tappet_file_abandon", "tappet_file_leave",
)  # fmt: skip
"""What libraries call for files."""

HEAP_SERVICES = ("tappet_allocate", "tappet_release", "tappet_elements", "tappet_element_size")
"""What __NEW and __DELETE call."""

SERVICES = (
    "tappet_fault", "tappet_now_ns", "tappet_sleep_ns", "tappet_guard", "tappet_task_current",
    "tappet_keep_fault", "tappet_rethrow", "tappet_exception_code",
    "tappet_watchdog_disable", "tappet_watchdog_enable", "tappet_set_aside", "tappet_take_back",
    "tappet_unix_ns", "tappet_task_facts", "tappet_application_facts", "tappet_log", "tappet_types",
    "tappet_debug_statement", "tappet_debug_exit", *FILE_SERVICES, *HEAP_SERVICES,
)  # fmt: skip
"""What compiled applications and libraries may call."""

HOST_FUNCTIONS = (
    "clock_gettime", "clock_nanosleep", "gettid", "getpid", "tgkill", "pthread_self",
    "pthread_getspecific", "pthread_setspecific", "pthread_sigmask",
    "pthread_mutex_lock", "pthread_mutex_trylock", "pthread_mutex_unlock", "sigaltstack", "signal", "prctl",
    "syscall",
    "sem_post", "sem_wait", "abort", "calloc", "free", "_setjmp", "longjmp", "_longjmp",
    "__errno_location", "openat", "close", "read", "write", "lseek", "ftruncate", "fsync", "statx",
    "unlinkat", "renameat", "mkdirat", "fdopendir", "readdir", "closedir",
)  # fmt: skip
"""What the executive itself takes from the C library."""

REGISTRY_SYMBOL = "tappet.data.PROCESS"
"""The global variable list `process.st`; its only member is the registry."""
_LISTS = {"process.st": "Process"}
_SIGNED = {"DINT", "LINT", "INT", "SINT"}


def sources() -> list[Source]:
    """The ST texts of the executive."""
    files = sorted(FOLDER.glob("*.st"))
    return [
        Source(f"executive/{f.name}", f.read_text(encoding="utf-8"), Scope.LIBRARY, name=_LISTS.get(f.name))
        for f in files
    ]


def build_executive() -> tuple[bytes, dict[str, Layout]]:
    """Object code and structure layouts; compiled once per version and kept in the user's cache."""
    texts = sources()
    digest = hashlib.blake2b(digest_size=20)
    digest.update(f"{llvmlite.__version__}|{compiler_stamp()}|".encode())
    for source in texts:
        digest.update(source.text.encode())
    cache = ObjectCache(cache_folder("executive"))
    name = digest.hexdigest()
    code, table = cache.read(name), cache.read(name + "-layout")
    if code is not None and table is not None:
        return code, _layouts_from_table(json.loads(table))
    from tappet.codegen.system import build_system  # the compiler is needed only when the cache is empty

    system = build_system(texts)
    rows: dict[str, list[object]] = {}
    for structure in STRUCTURES:
        members = system.members_of(structure)
        places = {k: (offset, size, kind in _SIGNED) for k, (offset, size, kind) in members.items()}
        rows[structure] = [system.size_of(structure), places]
    cache.write(name, system.object)
    cache.write(name + "-layout", json.dumps(rows).encode())
    return system.object, _layouts_from_table(rows)


def _layouts_from_table(table: Mapping[str, list[object]]) -> dict[str, Layout]:
    layouts = {}
    for name, (size, members) in table.items():
        assert isinstance(size, int)
        assert isinstance(members, dict)
        layouts[name] = Layout(name, size, {k: MemberPlace(*place) for k, place in members.items()})
    return layouts


class Executive:
    """The linked executive. One per process, because signal handlers belong to the process."""

    _instance: Executive | None = None
    _creation = threading.Lock()

    @classmethod
    def shared(cls) -> Executive:
        """The executive of this process, built and linked at the first call."""
        with cls._creation:
            if cls._instance is None:
                cls._instance = cls()
            return cls._instance

    def __init__(self) -> None:
        code, self.layouts = build_executive()
        self.linker = Linker()
        self._registry_block = Block(self.layouts["EXECUTIVE_REGISTRY"].size)
        self.registry = Record(self.layouts["EXECUTIVE_REGISTRY"], self._registry_block.address)
        self._fill_registry()
        imports = {name: posix.symbol_address(name) for name in HOST_FUNCTIONS}
        imports[REGISTRY_SYMBOL] = self.registry.address
        self._code: LinkedCode = self.linker.link([code], (*ENTRIES, *SERVICES), imports)
        self.services = {name: self._code[name] for name in SERVICES}
        self.entries = {name: self._code[name] for name in ENTRIES}
        prototype = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_uint64, ctypes.c_uint64)
        self._store = prototype(self.entries["tappet_store"])
        self._store_flag = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_uint64, ctypes.c_int32)(
            self.entries["tappet_store_flag"]
        )
        self._load = ctypes.CFUNCTYPE(ctypes.c_uint64, ctypes.c_uint64)(self.entries["tappet_load"])
        self._apply = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_uint64)(self.entries["tappet_apply_values"])
        self._save = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_uint64)(self.entries["tappet_save_retain"])
        self._reset_files = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_uint64)(
            self.entries["tappet_files_reset"]
        )
        self._sweep_files = ctypes.CFUNCTYPE(None, ctypes.c_uint64)(self.entries["tappet_files_sweep"])
        self._begin_heap = ctypes.CFUNCTYPE(None, ctypes.c_uint64)(self.entries["tappet_heap_begin"])
        self._check_heap = ctypes.CFUNCTYPE(ctypes.c_uint32, ctypes.c_uint64)(
            self.entries["tappet_heap_check"]
        )
        self._install_handlers()

    def _fill_registry(self) -> None:
        places = posix.register_places()
        registry = self.registry
        registry["key"] = posix.create_thread_key()
        registry["watchdogSignal"] = posix.WATCHDOG_SIGNAL
        registry["offsetPc"] = places.pc
        registry["offsetFp"] = places.frame
        registry["offsetSp"] = places.stack
        registry["offsetAddress"] = posix.SIGNAL_ADDRESS_OFFSET
        registry["rseqOffset"], registry["rseqSize"] = posix.restartable_sequences()
        mask = (1 << 64) - 1
        for signal in (*posix.FAULT_SIGNALS, posix.ABORT_SIGNAL, posix.WATCHDOG_SIGNAL):
            mask &= ~(1 << signal - 1)
        blocked = mask.to_bytes(8, "little") + b"\xff" * 120
        posix.write_memory(registry.place("signalMask"), blocked)
        own = (1 << posix.WATCHDOG_SIGNAL - 1).to_bytes(8, "little")
        posix.write_memory(registry.place("watchdogMask"), own)

    def _install_handlers(self) -> None:
        handler = self.entries["tappet_signal"]
        previous = self.registry.place("previous")
        for signal in (*posix.FAULT_SIGNALS, posix.ABORT_SIGNAL, posix.WATCHDOG_SIGNAL):
            again = signal in posix.FAULT_SIGNALS  # these never come back to the place they interrupted
            posix.install_handler(signal, handler, previous + signal * 160, unmasked=again)

    # -- what Python does to memory that tasks read -----------------------------------------------------

    def store(self, address: int, value: int) -> None:
        """Store a pointer or word so that every task sees it and all that was written before it."""
        self._store(address, value)

    def store_flag(self, address: int, value: int) -> None:
        """Store a 32-bit flag with the same guarantee."""
        self._store_flag(address, value)

    def load(self, address: int) -> int:
        """Read a word behind a full barrier."""
        return int(self._load(address))

    def apply_values(self, address: int) -> None:
        """Store a list of values now; only while no task runs."""
        self._apply(address)

    def save_retain(self, address: int) -> None:
        """Copy a retain group into its file now; only while its task does not run."""
        self._save(address)

    def reset_files(self, address: int) -> bool:
        """Close the files of an application; only while no task runs. False while a request is served."""
        return bool(self._reset_files(address))

    def sweep_files(self, address: int) -> None:
        """Abandon the requests of blocks that an online change has removed; only while no task runs."""
        self._sweep_files(address)

    def begin_heap(self, address: int) -> None:
        """Make the arena of a HEAP_ARENA one free block; only while no task runs."""
        self._begin_heap(address)

    def check_heap(self, address: int) -> int:
        """Number of a block of a HEAP_ARENA that was written beyond its bounds, or 0."""
        return int(self._check_heap(address))
