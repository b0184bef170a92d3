"""Numbers for Prometheus, in its text format."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING

from tappet.runtime.tasks import TaskStatistics

if TYPE_CHECKING:
    from tappet.server.online.channel import OnlineChannel
    from tappet.server.runtimes.links import RuntimeRegistry

CONTENT_TYPE = "text/plain; version=0.0.4; charset=utf-8"


TASK_NUMBERS: tuple[tuple[str, str, str, Callable[[TaskStatistics], float]], ...] = (
    ("cycles_total", "counter", "Cycles that ran the programs.", lambda t: t.iec_cycles),
    ("overruns_total", "counter", "Cycles still running when the next was due.", lambda t: t.overruns),
    ("execution_seconds_max", "gauge", "Longest execution of the programs.", lambda t: t.max_ns / 1e9),
    ("execution_seconds_average", "gauge", "Mean execution.", lambda t: t.average_ns / 1e9),
    ("lateness_seconds_max", "gauge", "Latest start of a cycle.", lambda t: t.jitter_max_ns / 1e9),
)


class Metrics:
    """What the server counts since it was started."""

    def __init__(self) -> None:
        self.requests: Counter[tuple[str, int]] = Counter()
        """By method and status."""
        self.builds: Counter[str] = Counter()
        """By outcome: ok, errors, cancelled, crashed."""
        self.build_seconds = 0.0
        self.frames_sent = 0
        self.frames_replaced = 0
        self.online_channels: set[OnlineChannel] = set()

    def channel_closed(self, channel: OnlineChannel) -> None:
        """Keeps the numbers of a channel that is gone."""
        self.online_channels.discard(channel)
        self.frames_sent += channel.outbox.sent
        self.frames_replaced += channel.outbox.replaced

    def render(self, runtimes: RuntimeRegistry, tasks: dict[str, list[TaskStatistics]]) -> str:
        """All of it as text; `tasks` are the statistics of each runtime that answered, by its name."""
        lines: list[str] = []
        sent = self.frames_sent + sum(c.outbox.sent for c in self.online_channels)
        replaced = self.frames_replaced + sum(c.outbox.replaced for c in self.online_channels)
        _family(
            lines,
            "tappet_http_requests_total",
            "counter",
            "Requests answered.",
            (({"method": m, "status": str(s)}, n) for (m, s), n in sorted(self.requests.items())),
        )
        _family(
            lines,
            "tappet_builds_total",
            "counter",
            "Builds by outcome.",
            (({"outcome": outcome}, n) for outcome, n in sorted(self.builds.items())),
        )
        _single(lines, "tappet_build_seconds_total", "counter", "Time spent in builds.", self.build_seconds)
        _single(lines, "tappet_online_channels", "gauge", "Open online sockets.", len(self.online_channels))
        _single(lines, "tappet_online_frames_sent_total", "counter", "Frames sent to browsers.", sent)
        _single(
            lines,
            "tappet_online_frames_replaced_total",
            "counter",
            "Frames that a newer one replaced before they were sent.",
            replaced,
        )
        links = runtimes.all()
        _family(
            lines,
            "tappet_runtime_connected",
            "gauge",
            "1 while the runtime answers.",
            (({"runtime": link.name}, int(link.connected)) for link in links),
        )
        _family(
            lines,
            "tappet_runtime_running",
            "gauge",
            "1 while the application runs.",
            (({"runtime": link.name}, int(link.state().state == "run" and link.connected)) for link in links),
        )
        for name, kind, text, number in TASK_NUMBERS:
            samples = [
                ({"runtime": runtime, "task": task.name}, number(task))
                for runtime, found in tasks.items()
                for task in found
            ]
            _family(lines, f"tappet_task_{name}", kind, text, samples)
        return "\n".join(lines) + "\n"


def _single(lines: list[str], name: str, kind: str, text: str, value: float) -> None:
    _family(lines, name, kind, text, [({}, value)])


def _family(
    lines: list[str], name: str, kind: str, text: str, samples: Iterable[tuple[dict[str, str], float]]
) -> None:
    lines += [f"# HELP {name} {text}", f"# TYPE {name} {kind}"]
    for labels, value in samples:
        inside = ",".join(f'{key}="{_escape(label)}"' for key, label in labels.items())
        lines.append(f"{name}{{{inside}}} {value:g}" if inside else f"{name} {value:g}")


def _escape(label: str) -> str:
    return label.replace("\\", r"\\").replace('"', r"\"").replace("\n", r"\n")
