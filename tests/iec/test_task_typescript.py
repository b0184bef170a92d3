"""What the editors in the browser know of the tasks of a device is what its description says (TASK-07)."""

from pathlib import Path

from tappet.iec.task_typescript import FILE, module

ROOT = Path(__file__).parents[2]


def test_the_module_is_up_to_date() -> None:
    assert (ROOT / FILE).read_text(encoding="utf-8") == module(), "run 'make generate'"
