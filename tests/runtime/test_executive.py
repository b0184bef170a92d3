"""The contract between the ST structures and Python."""

import re

from tappet.codegen.faults import Fault
from tappet.runtime.contexts import FAULTED, RUNNING, STOPPED
from tappet.runtime.executive.loader import ENTRIES, FOLDER, SERVICES, Executive
from tappet.runtime.faults import ABORTED
from tappet.runtime.tasks import KINDS, LATENESS_STEP_NS, quantile


def enumeration(name: str) -> dict[str, int]:
    text = (FOLDER / "types.st").read_text()
    body = re.search(rf"TYPE {name} : \(([^)]*)\)", text)
    assert body is not None
    return {k: int(v) for k, v in re.findall(r"(\w+) := (\d+)", body[1])}


def test_fault_codes_are_those_of_the_compiler() -> None:
    codes = {("ASSERT" if k == "ASSERTION" else k): v for k, v in enumeration("FAULT_CODE").items()}
    assert codes.pop("NONE") == 0
    assert codes.pop("ABORTED") == ABORTED
    assert codes == {f.name: f.value for f in Fault}


def test_states_and_kinds_are_those_of_the_sources() -> None:
    assert enumeration("APPLICATION_STATE") == {"STOPPED": STOPPED, "RUNNING": RUNNING, "FAULTED": FAULTED}
    assert {k.lower(): v for k, v in enumeration("TASK_KIND").items()} == KINDS


def test_every_entry_and_service_is_exported_by_the_sources() -> None:
    texts = "".join(f.read_text() for f in FOLDER.glob("*.st"))
    exported = set(re.findall(r"'tappet_export' := '(\w+)'", texts))
    assert exported == {*ENTRIES, *SERVICES}


def test_shared_words_are_aligned() -> None:
    for layout in Executive.shared().layouts.values():
        for name, place in layout.members.items():
            if place.size in (2, 4, 8):
                assert place.offset % place.size == 0, f"{layout.name}.{name}"


def test_quantile_of_the_lateness_histogram() -> None:
    classes = [0] * 512
    assert quantile(tuple(classes), 0.999) == 0
    classes[3] = 999
    classes[100] = 1
    assert quantile(tuple(classes), 0.999) == 4 * LATENESS_STEP_NS
    assert quantile(tuple(classes), 1.0) == 101 * LATENESS_STEP_NS
