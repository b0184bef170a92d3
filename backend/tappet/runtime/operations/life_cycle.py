"""Who a runtime is, and the life cycle of its application: start, stop, single cycle, resets."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar, Literal

from tappet.runtime.operations.declaration import Fact, Operation, Rest, Text
from tappet.runtime.state import RuntimeInfo

if TYPE_CHECKING:
    from tappet.runtime.plc import SoftPlc


class Hello(Operation[RuntimeInfo], frozen=True):
    """The first message of a connection: the token of the runtime."""

    op: ClassVar[str] = "hello"
    token: Text

    def run(self, plc: SoftPlc) -> RuntimeInfo:
        """The service has compared the token."""
        return plc.info()


class GetInfo(Operation[RuntimeInfo], frozen=True):
    """Identity, state and application."""

    op: ClassVar[str] = "info"
    of_recordings: ClassVar[bool] = True

    def run(self, plc: SoftPlc) -> RuntimeInfo:
        """Ask the PLC."""
        return plc.info()


class Start(Operation[None], frozen=True):
    """Start the application."""

    op: ClassVar[str] = "start"
    rest: ClassVar[Rest | None] = Rest("POST", "/start", "operator", lambda _: Fact("start"), "state")

    def run(self, plc: SoftPlc) -> None:
        """From the next cycle on."""
        plc.start()


class Stop(Operation[None], frozen=True):
    """Stop the application; its outputs go to their safe values."""

    op: ClassVar[str] = "stop"
    rest: ClassVar[Rest | None] = Rest(
        "POST", "/stop", "operator", lambda _: Fact("stop"), "state", always=True
    )

    def run(self, plc: SoftPlc) -> None:
        """At the end of the cycles."""
        plc.stop()


class SingleCycle(Operation[None], frozen=True):
    """Run one cycle of each cyclic and freewheeling task of a stopped application."""

    op: ClassVar[str] = "single_cycle"
    rest: ClassVar[Rest | None] = Rest(
        "POST", "/single-cycle", "operator", lambda _: Fact("single-cycle"), "state"
    )

    def run(self, plc: SoftPlc) -> None:
        """Returns when the cycle is over."""
        plc.single_cycle()


class CreateBootApplication(Operation[None], frozen=True):
    """Make the loaded application the one that the runtime starts with."""

    op: ClassVar[str] = "create_boot_application"
    rest: ClassVar[Rest | None] = Rest(
        "POST", "/boot-application", "engineer", lambda _: Fact("boot-application"), "state"
    )

    def run(self, plc: SoftPlc) -> None:
        """Returns when the disk has it."""
        plc.create_boot_application()


class Reset(Operation[None], frozen=True):
    """Initialise the variables: warm (not RETAIN), cold (not PERSISTENT), origin (all, and unload)."""

    op: ClassVar[str] = "reset"
    rest: ClassVar[Rest | None] = Rest(
        "POST", "/reset", "engineer", lambda order: Fact(f"reset-{order.kind}"), "state"
    )
    kind: Literal["warm", "cold", "origin"]

    def run(self, plc: SoftPlc) -> None:
        """Stops a running application first."""
        plc.reset(self.kind)
