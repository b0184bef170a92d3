"""Random edits of random programs, changed online: what kept name and type keeps its value (LDEC-47, 103).

Each build in one session also gives the code that a build of everything gives.
"""

from __future__ import annotations

import sys
from pathlib import Path
from random import Random
from typing import Any

import compared
import pytest
import write_st
from arithmetic import Fault, same
from bytes_in_memory import Unsettled
from edited_programs import EditMaker, changed_over
from linked_application import ApplicationFault, LoadedApplication
from reference import Machine
from reference_values import TooLong
from typed_tree import Program

from tappet.codegen.build import BuildOptions, BuildSession, build_application
from tappet.codegen.package import CodePackage
from tappet.lang.source import Source

sys.path.append(str(Path(__file__).parents[1] / "codegen"))
from compiled_programs import change_over

OPTIONS = BuildOptions(level=1, libraries=compared.LIBRARIES)
LISTS = ("Globals", "Bits")


def built(program: Program, session: BuildSession, previous: CodePackage | None) -> CodePackage:
    sources = [
        Source(name, text, name=name if name in LISTS else None)
        for name, text in write_st.objects(program).items()
    ]
    result = build_application(sources, (), OPTIONS, previous, session)
    errors = [str(d) for d in result.diagnostics if d.severity == "error"]
    if result.package is None:
        raise compared.RefusedError("\n".join([*errors, write_st.program(program)]))
    return result.package


def cycles(machine: Machine, application: LoadedApplication) -> bool:
    """Some cycles of both; False after a fault, which both must have."""
    faults: list[Any] = [None, None]
    for _ in range(machine.program.cycles):
        try:
            machine.cycle()
        except Fault as fault:
            faults[0] = fault
        try:
            application.cycle()
        except ApplicationFault as fault:
            faults[1] = fault
        assert (faults[0] is None) == (faults[1] is None), faults
        if faults[0] is not None:
            return False
    return True


def wrong(machine: Machine, application: LoadedApplication) -> list[str]:
    """Variables that differ."""
    found = []
    for path, (expected, actual) in compared.both(machine, application).items():
        if not same(expected, actual):
            found.append(f"{path}: expected {expected!r}, got {actual!r}")
    return found


def check(seed: int, edits: int, size: int = 4, whole: bool = False) -> None:
    maker = EditMaker(Random(seed), size=size)
    program = maker.program()
    session = BuildSession()
    package = built(program, session, None)
    machine, applications = Machine(program), [LoadedApplication(package)]
    try:
        applications[0].start()
        for number in range(edits):
            before = write_st.program(machine.program)
            try:
                if not cycles(machine, applications[-1]):
                    return
            except (TooLong, Unsettled):
                return
            assert wrong(machine, applications[-1]) == [], f"seed {seed}, before edit {number}"
            program = maker.edited(program)
            package = built(program, session, package)
            if whole:
                assert package.code_id == built(program, BuildSession(), applications[-1].package).code_id
            try:
                machine = changed_over(machine, program)
            except Unsettled:
                return
            applications.append(change_over(applications[-1], package))
            found = wrong(machine, applications[-1])
            texts = [before, "// -- after the edit --", write_st.program(program)]
            assert found == [], "\n".join([f"seed {seed}, edit {number}", *found, *texts])
    finally:
        for application in reversed(applications):
            application.close()


@pytest.mark.parametrize("seed", range(6))
def test_edits(seed: int) -> None:
    check(seed, 3, whole=seed % 3 == 0)


@pytest.mark.slow
@pytest.mark.parametrize("block", range(10))
def test_many_edits(block: int) -> None:
    for seed in range(1000 + 20 * block, 1020 + 20 * block):
        check(seed, 4, size=8, whole=True)
