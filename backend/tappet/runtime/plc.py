"""The soft PLC: one application at a time and its life cycle (start, stop, resets, download, online change).

States: empty (no application), stop, run, exception. All methods may be called from any thread.
"""

from __future__ import annotations

import time
from typing import get_args

from tappet.codegen.package import CodePackage, PackageError
from tappet.disk_full import is_disk_full
from tappet.iec.task import SOFT_PLC
from tappet.runtime.application import LoadedApplication
from tappet.runtime.boot import (
    BootError,
    create_boot,
    load_boot,
    remove_boot,
    storing_boot,
)
from tappet.runtime.contexts import FAULTED, RUNNING, STOPPED
from tappet.runtime.crash import Crash
from tappet.runtime.errors import DiskFullError, PlcError
from tappet.runtime.exception_report import summary
from tappet.runtime.faults import RawFault
from tappet.runtime.flight import note_flight
from tappet.runtime.image import ImageError
from tappet.runtime.link import LinkError
from tappet.runtime.online_change import OnlineChangeError, apply_change
from tappet.runtime.plc_state import PlcState
from tappet.runtime.reports import build_report
from tappet.runtime.retain import Kept, load_retain, note_lost, persistent_of, remove_retain
from tappet.runtime.retain_groups import check_room
from tappet.runtime.standstill import stop_axes
from tappet.runtime.state import ResetKind
from tappet.runtime.system_events import happened
from tappet.runtime.task_group import TaskError


class SoftPlc(PlcState):
    """Life cycle of one PLC."""

    def start(self) -> None:
        """Run the programs from the next cycle on. PlcError in the state exception: reset first.

        What was not started because it had ended the process is started all the same.
        """
        with self._lock:
            application = self._need()
            if self._crash is not None:
                self.reset("warm")
            if application.tasks.state == FAULTED:
                raise PlcError(
                    "the application is in the state exception; reset it (warm or cold) before starting"
                )
            if application.tasks.state != RUNNING and happened(application, "PrepareStart", self.log):
                application.run()
                self.log.add("info", "application", f"{application.package.application} started")
                happened(application, "StartDone", self.log)
                self._notify("state")

    def single_cycle(self) -> None:
        """Run one cycle of each cyclic and freewheeling task of a stopped application (LST-84).

        The outputs then hold what the cycle has set, unless they are to be safe while stopped. PlcError when
        the application runs or is in the state exception.
        """
        with self._lock:
            application = self._need()
            if application.halted:
                self.debugger.control("single_cycle")
                return
            if application.tasks.state != STOPPED:
                raise PlcError(
                    f"a single cycle needs a stopped application; this one is in state {self.state}"
                )
            if self.virtual:
                raise PlcError("a single cycle needs real time; virtual time is advanced instead")
            self.log.add("info", "application", f"{application.package.application}: single cycle")
            try:
                application.tasks.single_cycle()
            except TaskError as error:
                raise PlcError(str(error)) from error
            if not application.halted:
                self._save_retain()
            self.poll()

    def stop(self) -> None:
        """Complete the running cycles, then call no program; values stay. Axes come to standstill before."""
        was_running = self.state == "run"
        self.happen("PrepareStop", when=was_running)
        self._stop_axes()
        with self._lock:
            application = self._need()
            application.tasks.stop()
            self._save_retain()
            self._mark.settle()
            if was_running:
                self.log.add("info", "application", f"{application.package.application} stopped")
                happened(application, "StopDone", self.log)
                self._notify("state")

    def _stop_axes(self) -> None:
        """The controlled stop of the axes; others are served meanwhile."""
        stop_axes(lambda: self.application, self._lock, self.log)

    def reset(self, kind: str) -> None:
        """Back to initial values as the table of remanent variables says (PERS-02); the application is
        stopped.

        `kind` is warm, cold or origin; origin also removes the application, its boot copy and everything
        remanent.
        """
        if kind not in get_args(ResetKind):
            raise PlcError(f"unknown reset '{kind}'; known are warm, cold and origin")
        self.happen("PrepareReset")
        self._stop_axes()
        with self._lock:
            application = self._need()
            if kind == "origin":
                self._reset_origin(application)
                return
            if application.tasks.state == RUNNING:
                application.tasks.set_state(STOPPED)
            with application.tasks.standing():
                kept = application.kept_values(retain=kind == "warm")
                application.tasks.set_state(STOPPED)
                self._report = None
                if self._crash is not None:
                    self._begin(application)
                fault = application.initialise(kept, keep_no_init=True)
            self.happen("ResetDone", when=fault is None)
            self._save_retain()
            self.log.add("info", "application", f"{application.package.application} reset {kind}")
            self._after_initialise(fault)

    def _reset_origin(self, application: LoadedApplication) -> None:
        self._unload(application, leave=True)
        self._crash = None
        self._mark.end()
        if self.folder is not None:
            remove_boot(self.folder)
            remove_retain(self.folder)
        self.source.remove()
        self.log.add("info", "application", f"{application.package.application} reset origin: removed")
        self._notify("application")

    def _after_initialise(self, fault: RawFault | None) -> None:
        if fault is not None:
            self.poll()
        self._notify("exception" if self.state == "exception" else "state")

    # -- download ----------------------------------------------------------------------------------------

    def download(self, data: bytes, mode: str = "download") -> None:
        """Load a package; it is stopped afterwards (mode `download`) or continues to run (`online_change`).

        Raises PlcError; with a refused package the old application stays as it was.
        """
        try:
            package = CodePackage.from_bytes(data)
        except PackageError as error:
            raise PlcError(f"the package was refused: {error}") from error
        with self._lock:
            with storing_boot(self.folder, data, self.log):
                if mode == "online_change":
                    self._change(package)
                elif mode == "download":
                    self._load(package, None)
                else:
                    raise PlcError(f"unknown mode '{mode}'; known are download and online_change")
            self._notify("application")

    def create_boot_application(self) -> None:
        """Make the loaded application, as it is after its online changes, the one that is started when the
        process begins. A download does so by itself; this stores it again where that failed or the file was
        removed or replaced. Raises PlcError.
        """
        with self._lock:
            application = self._need()
            try:
                create_boot(self.folder, application.package, self.log)
            except BootError as error:
                raise PlcError(str(error)) from error

    def load(self, package: CodePackage) -> None:
        """Load a package that is at hand as an object, without storing it as boot application."""
        with self._lock:
            self._load(package, None)
            self._notify("application")

    def change(self, package: CodePackage) -> None:
        """Online change to a package that is at hand as an object, without storing it as boot application."""
        with self._lock:
            self._change(package)
            self._notify("application")

    def _begin(self, application: LoadedApplication, starts: int = 0) -> None:
        """From now on the next process hears of it when this one is ended."""
        self._crash = None
        self._mark.begin(application.package, starts)
        self._mark.linked(application)

    def _load(
        self, package: CodePackage, kept: Kept | None, *, starts: int = 0, crash: Crash | None = None
    ) -> None:
        """Replace the application. Values to keep come from the running one (persistent only) or from
        `kept`. After a crash it is only loaded; `starts` counts starts from boot.
        """
        most = SOFT_PLC.most_tasks
        if len(package.tasks) > most:
            raise PlcError(
                f"the package was refused: {len(package.tasks)} tasks; at most {most} are possible"
            )
        try:
            application = LoadedApplication(
                self.executive,
                package,
                virtual=self.virtual,
                scheduling=self.scheduling,
                stuck_limit_s=self.stuck_limit_s,
                flight=self.flight,
                folder=self.folder,
                image_address=self.image_address,
            )
        except (LinkError, ImageError, OSError) as error:
            if is_disk_full(error):
                raise DiskFullError("there is no room for the files of the application") from error
            raise PlcError(f"the package was refused: {error}") from error
        try:
            check_room(self.folder, package)
        except DiskFullError:
            application.close()
            raise
        old = self.application
        self.happen("PrepareDownload")
        if kept is None:
            kept = persistent_of(old, package, self.folder)
        if old is not None:
            self._unload(old, leave=True)
        self.application = application
        self._report = None
        self.debugger.dropped()
        fault = None
        if crash is None:
            self._begin(application, starts)
            fault = application.initialise(kept)
        else:
            application.hold(kept)
            self._crash, self._report = crash, crash.report(application, self.log)
            self.log.add("exception", "application", summary(self._report))
        note_lost(kept, application.remanent(), self.log)
        if self.folder is not None:
            try:
                application.open_retain_file(self.folder)
            except OSError as error:
                self.log.add("error", "retain", f"remanent variables are not kept: {error}")
        if not self.virtual:
            for note in application.tasks.launch(package.tasks):
                self.log.add("info", "scheduler", note)
        for note in self._notes()[len(self.scheduling.notes) :]:
            self.log.add("warning", "image", note)
        note_flight(application, self.flight, self.log)
        self.log.add("info", "application", f"{package.application} loaded ({package.code_id[:12]})")
        self.happen("DownloadDone", when=fault is None and crash is None)
        if fault is not None:
            self.poll()

    def _unload(self, application: LoadedApplication, *, leave: bool) -> None:
        """End an application; with `leave` its FB_Exit methods are called."""
        if leave:
            happened(application, "PrepareExit", self.log)
        self._stop_axes()
        application.tasks.stop()
        application.log.collect(self.log)
        if leave and application.tasks.state != FAULTED:
            with application.tasks.standing():
                fault = application.run_exit()
            if fault is not None:
                report = build_report(application, self.log)
                self.log.add("error", "application", f"ended by an exception: {summary(report)}")
        self.application = None
        self._report = None
        self.debugger.dropped()
        application.close()

    def _change(self, package: CodePackage) -> None:
        application = self._need()
        if self._crash is not None:
            raise PlcError("online change refused: the application waits to be started; download the new one")
        check_room(self.folder, package)
        self.happen("PrepareOnlineChange")
        begun = time.monotonic()
        try:
            result = apply_change(application, package, self.folder, self.log)
        except (OnlineChangeError, ImageError, LinkError, TaskError) as error:
            raise PlcError(f"online change refused: {error}") from error
        took = (time.monotonic() - begun) * 1000
        how = "tasks paused" if result.paused else "code exchanged while running"
        self._mark.linked(application)
        self.debugger.dropped()
        self.log.add("info", "application", f"{package.application} changed online in {took:.0f} ms, {how}")
        if result.retain_problem:
            self.log.add("error", "retain", f"remanent variables are not kept: {result.retain_problem}")
        if result.paused:
            note_flight(application, self.flight, self.log)
        if result.lost_forces:
            released = len(result.lost_forces)
            self.log.add("warning", "forces", f"forces released because their variables are gone: {released}")
            self._notify("forces")
        if result.report is not None:
            self._report = result.report
            self.log.add("exception", "application", summary(result.report))
            self.poll()
        self.happen("OnlineChangeDone", when=result.report is None)

    def boot(self) -> bool:
        """Load and start the boot application with its remanent values; False when there is none or it
        fails. One that has ended the process before is loaded only, in the state exception.
        """
        if self.folder is None:
            return False
        with self._lock:
            try:
                package = load_boot(self.folder)
                if package is None:
                    return False
                crash = self._mark.found()
                if crash is not None and not crash.concerns(package, self.log):
                    crash = None
                kept, problems = load_retain(self.folder)
                for problem in problems:
                    self.log.add("error", "retain", problem)
                waits = crash if crash is not None and crash.waits else None
                starts = 1 if crash is None else crash.kept.starts + 1
                if waits is None:
                    self._mark.begin(package, starts)
                self._load(package, kept, starts=starts, crash=waits)
                if self.state == "stop":
                    self.start()
            except (BootError, PlcError) as error:
                self.log.add("error", "boot", str(error))
                return False
            self._notify("application")
            return True

    # -- end ---------------------------------------------------------------------------------------------

    def close(self) -> None:
        """Stop the application, save its remanent values and release everything."""
        self._stop_axes()
        with self._lock:
            application = self.application
            if application is None:
                return
            application.tasks.stop()
            self._save_retain()
            self._unload(application, leave=False)
            if self._crash is None:
                self._mark.end()
