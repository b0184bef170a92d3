"""Builds and runs one case of `data/language_examples.json` (format: language_operators.md section 0)."""

from __future__ import annotations

import ctypes
import json
import math
import os
import re
import resource
import select
import signal
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from linked_application import ApplicationFault, LoadedApplication

from tappet.codegen.build import BuildOptions, BuildResult, LibraryReference, build_application
from tappet.codegen.package import CodePackage, rearranged
from tappet.codegen.symbol_map import SymbolError, VarRef
from tappet.lang.source import Scope, Source

DATA = Path(__file__).parent / "data" / "language_examples.json"
CYCLE_NS = 10_000_000
PATIENCE_S = 2
"""A case that computes longer than this counts as endless, however busy the machine is."""
BLOCKED_S = 300
"""A case that neither ends nor computes."""


def load_cases() -> list[dict[str, Any]]:
    return json.loads(DATA.read_text(encoding="utf-8"))


def sources_of(case: dict[str, Any]) -> list[Source]:
    """The texts of a case; PLC_PRG is made of declaration and code unless an object replaces it."""
    found: list[Source] = []
    replaced = False
    for number, text in enumerate(case.get("objects", [])):
        kind, _, rest = text.partition(":")
        words = kind.split()
        if len(words) == 2 and words[0] in ("GVL", "PERSISTENT"):
            found.append(Source(words[1], rest.strip(), name=words[1]))
        elif len(words) == 2 and words[0] == "LIBRARY":
            name = words[1]
            found.append(
                Source(f"{name}/{number}", rest.strip(), Scope.LIBRARY, library=name, namespace=name)
            )
        elif text.lstrip().startswith(("VAR_GLOBAL", "VAR_CONFIG", "{")) and "VAR_" in text:
            found.append(Source(f"Globals{number}", text, name=f"Globals{number}"))
        else:
            replaced |= re.search(r"^\s*PROGRAM\s+PLC_PRG\b", text, re.IGNORECASE | re.MULTILINE) is not None
            found.append(Source(f"object{number}", text))
    if not replaced:
        body = f"PROGRAM PLC_PRG\n{case['declaration']}\n{case['code']}\nEND_PROGRAM"
        found.insert(0, Source("PLC_PRG", body))
    return found


def build(case: dict[str, Any], previous: CodePackage | None = None) -> BuildResult:
    byte_addressing = case.get("options", {}).get("byte_addressing", False)
    libraries = (LibraryReference("Standard"), LibraryReference("Standard64"))
    options = BuildOptions(
        byte_addressing=byte_addressing, level=1, libraries=libraries, free_addresses=False
    )
    return build_application(sources_of(case), options=options, previous=previous)


@dataclass
class Outcome:
    errors: list[str]
    warnings: list[str]
    fault: str | None
    values: dict[str, Any]


def resolve(package: CodePackage, path: str) -> VarRef:
    try:
        return package.symbols.resolve(f"PLC_PRG.{path}")
    except SymbolError:
        return package.symbols.resolve(path)


def run(case: dict[str, Any], result: BuildResult) -> Outcome:
    """What a built case does."""
    errors = [str(d) for d in result.diagnostics if d.severity == "error"]
    warnings = [str(d) for d in result.diagnostics if d.severity != "error"]
    if result.package is None:
        return Outcome(errors, warnings, None, {})
    return guarded(lambda: _execute(case, result, warnings))


def guarded(work: Callable[[], Outcome]) -> Outcome:
    """Run in a child process, so that an endless loop or a crash shows as a fault."""
    reader, writer = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(reader)
        resource.setrlimit(resource.RLIMIT_CPU, (PATIENCE_S, 2 * PATIENCE_S))
        try:
            outcome = work()
            text = json.dumps(vars(outcome), default=str)
        except BaseException as error:  # the child must never return into pytest
            text = json.dumps({"errors": [], "warnings": [], "fault": f"harness: {error!r}", "values": {}})
        os.write(writer, text.encode())
        os._exit(0)
    os.close(writer)
    if not select.select([reader], [], [], BLOCKED_S)[0]:
        os.kill(child, signal.SIGKILL)
    data = b""
    while chunk := os.read(reader, 65536):
        data += chunk
    os.close(reader)
    _, status = os.waitpid(child, 0)
    if os.WIFSIGNALED(status) and os.WTERMSIG(status) == signal.SIGXCPU:
        return Outcome([], [], "watchdog", {})
    if not data:
        return Outcome([], [], f"signal {os.WTERMSIG(status)}", {})
    return Outcome(**json.loads(data))


def _execute(case: dict[str, Any], result: BuildResult, warnings: list[str]) -> Outcome:
    package = result.package
    assert package is not None
    application = LoadedApplication(package)
    try:
        application.start()
        for path, value in case.get("stimulus", {}).items():
            application.write(path, value)
        cycles = case["run_ms"] * 1_000_000 // CYCLE_NS if "run_ms" in case else case.get("cycles", 1)
        for _ in range(cycles):
            application.cycle()
            application.clock_ns += CYCLE_NS
        if "then" in case:
            application = _then(case, application)
        expected = case.get("expect_after_task", case["expect"])
        expected = expected.get("display", expected)
        values = {path: _value(application, path, want) for path, want in expected.items() if _is_path(path)}
        values = {path: repr(v) if isinstance(v, float) else v for path, v in values.items()}
    except ApplicationFault as fault:
        return Outcome([], warnings, str(fault), {})
    return Outcome([], warnings, None, values)


def _is_path(path: str) -> bool:
    return path not in ("error", "warning", "display", "completion", "symbols", "line", "messages")


def _value(application: LoadedApplication, path: str, want: Any) -> Any:
    """The value as the case writes it: a list flat, a time as the number of its literal."""
    package = application.package
    ref = resolve(package, path)
    data = ctypes.string_at(application.address + ref.offset, ref.size)
    value = package.symbols.decode(ref, data)
    return value if not isinstance(want, list) else _flat(value)


def _flat(value: Any) -> list[Any]:
    if isinstance(value, list):
        return [x for item in value for x in _flat(item)]
    return [value]


def _then(case: dict[str, Any], application: LoadedApplication) -> LoadedApplication:
    """What a runtime does at a reset, download or online change, by the facts of the package."""
    command = case["then"]
    package = application.package
    before = bytes(application.image[: package.image_size])
    if command == "online_change":
        changed = dict(
            case, objects=[*case.get("objects", []), "GVL Added:\nVAR_GLOBAL\n    x : INT;\nEND_VAR"]
        )
        result = build(changed, package)
        assert result.package is not None
        assert result.package.online_change is not None
        new = LoadedApplication(result.package)
        image = rearranged(result.package, before)
        ctypes.memmove(new.address, bytes(image), len(image))
        return new
    start_again(application, command.removeprefix("reset_"))
    return application


def start_again(application: LoadedApplication, command: str) -> None:
    """Reset (warm, cold, origin), download or reboot: all begins again but what keeps its value."""
    package = application.package
    before = bytes(application.image[: package.image_size])
    keep = [(r.offset, r.size) for r in package.persistent] if command != "origin" else []
    if command in ("warm", "reboot"):
        keep += [(r.offset, r.size) for r in package.retain]
    if command in ("warm", "cold", "origin"):
        keep += package.no_init
    application.start()
    for offset, size in keep:
        ctypes.memmove(application.address + offset, before[offset : offset + size], size)


def matches(case: dict[str, Any], package: CodePackage, path: str, got: Any, want: Any) -> bool:
    """Compare one value by the rules of the format."""
    ref = resolve(package, path)
    if want in ("+INF", "-INF"):
        return bool(float(got) == float(str(want)))
    if isinstance(want, str) and ref.type.kind not in ("string", "wstring"):
        raw = package.symbols.encode(ref, want)
        return got == package.symbols.decode(ref, raw)
    if isinstance(want, list):
        return len(got) == len(want) and all(_close(case, g, w) for g, w in zip(got, want, strict=True))
    if isinstance(want, bool):
        return bool(got) is want
    return _close(case, got, want)


def _close(case: dict[str, Any], got: Any, want: Any) -> bool:
    if isinstance(got, str) and isinstance(want, int | float):
        got = float(got)
    if isinstance(want, float) or isinstance(got, float):
        if isinstance(want, str):
            return repr(got) == want
        if math.isnan(got):
            return math.isnan(want)
        absolute = case.get("tolerance", 1e-6)
        relative = case.get("tolerance_rel", 1e-6)
        return math.isclose(got, want, rel_tol=relative, abs_tol=absolute)
    return bool(got == want)
