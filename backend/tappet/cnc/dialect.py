"""The commands and words of the dialect as JSON, for the editor in the browser.

`python -m tappet.cnc.dialect` prints it for `dialect.json` of the editor; a test fails when it is stale.
"""

from __future__ import annotations

import json
import sys

from tappet.cnc.commands import COMMANDS, LAST_M, LIMITLESS, M_WORDS, MODAL, MOST_SWITCHES, Command
from tappet.cnc.letters import AXES, LETTERS

FILE = "frontend/src/kinds/cnc/dialect.json"


def table() -> str:
    """All of it, in a fixed order."""
    facts = {
        "axes": AXES,
        "addresses": list(LETTERS),
        "modal": _ordered(MODAL),
        "limitless": _ordered(LIMITLESS),
        "functionLetters": _ordered(M_WORDS),
        "lastFunction": LAST_M,
        "mostSwitches": MOST_SWITCHES,
        "commands": {str(code): _command(COMMANDS[code]) for code in sorted(COMMANDS)},
    }
    return json.dumps(facts, indent=2) + "\n"


def _command(command: Command) -> dict[str, object]:
    return {
        "letters": _ordered(command.words),
        "needs": _ordered(command.needs),
        "travels": command.travels,
        "probes": command.probes,
        "numbers": [command.numbers[0], command.numbers[-1]] if command.numbers else None,
    }


def _ordered(addresses: frozenset[str]) -> list[str]:
    """In the order of their numbers."""
    return sorted(addresses, key=list(LETTERS).index)


if __name__ == "__main__":
    sys.stdout.write(table())
