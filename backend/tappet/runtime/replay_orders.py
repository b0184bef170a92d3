"""In which order tasks are replayed that ran at the same time.

Recorded is how many cycles of each task had ended when a cycle of the bus cycle task began and when it
ended, and whether one was under way (`flight_tasks`). Of the orders that this leaves, the recorded code takes
the one whose variables are nearest to the recorded ones.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import islice, product
from typing import NamedTuple

from tappet.runtime.flight_recording import RecordedCycle
from tappet.runtime.flight_tasks import TaskProgress

MOST_ORDERS = 24
"""That are tried in a cycle."""
MOST_AVOIDED = 50
"""Each costs another run."""


class Order(NamedTuple):
    """How many cycles of each task have been run, of all since its initialisation: before the cycle of the
    bus cycle task, and behind it."""

    before: tuple[int, ...]
    behind: tuple[int, ...]


def orders_differ(bus: int) -> Callable[[RecordedCycle], bool]:
    """Tells cycles in which other tasks ran at the same time as the bus cycle task."""
    return lambda one: any(task.beside for number, task in enumerate(one.tasks) if number != bus)


def possible_orders(tasks: Sequence[TaskProgress], bus: int, done: Sequence[int]) -> list[Order]:
    """The orders of a cycle in which `done` cycles of each task have been run before; first that in which
    what ended first runs first. A cycle that was under way may have done what others have seen of it."""
    known = list(enumerate(zip(tasks, done, strict=True)))
    ended = tuple(max(was, task.completed) for _, (task, was) in known)
    begun = tuple(max(was, task.completed if n == bus else (task.after + 1) // 2) for n, (task, was) in known)
    orders = (
        Order(before, tuple(map(max, before, behind)))
        for before in product(*_splits(tasks, bus, ended, begun, done))
        for behind in (ended, begun)
    )
    return list(dict.fromkeys((Order(ended, ended), *islice(orders, MOST_ORDERS))))


def _splits(
    tasks: Sequence[TaskProgress], bus: int, ended: Sequence[int], begun: Sequence[int], done: Sequence[int]
) -> Iterator[Sequence[int]]:
    for number, (task, was) in enumerate(zip(tasks, done, strict=True)):
        if number == bus or not task.beside:
            yield (ended[number],)
        else:
            yield range(max(was, task.before // 2), begun[number] + 1)


@dataclass
class FoundOrders:
    """What is known of the orders of a recording."""

    chosen: dict[int, Order] = field(default_factory=dict)
    """By the cycle of the bus cycle task, where there is a choice."""
    avoided: set[tuple[int, Order]] = field(default_factory=set)
    """They end in another fault than the recorded one."""
    searching: bool = True
    """Whether the recorded code runs, which is what can be compared."""

    def fixed(self) -> FoundOrders:
        """The chosen ones, for other code."""
        return FoundOrders(dict(self.chosen), searching=False)

    def of(self, cycle: int, orders: Sequence[Order]) -> list[Order]:
        """Those that are to be tried in a cycle; the first one where none else is left."""
        if not self.searching:
            return [self.chosen.get(cycle, orders[0])]
        return [order for order in orders if (cycle, order) not in self.avoided] or [orders[0]]
