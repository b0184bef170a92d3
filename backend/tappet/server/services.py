"""What one server process holds: opened at start-up, closed at the end, reached through dependencies."""

from __future__ import annotations

import asyncio
import logging
from dataclasses import dataclass, field
from datetime import UTC, datetime

from sqlalchemy import Connection, select

from tappet.project.store import Store
from tappet.server.analysis.project import Limits
from tappet.server.analysis.service import AnalysisService
from tappet.server.audit import Act, write
from tappet.server.audit_reserve import AuditReserve
from tappet.server.auth import accounts, sessions
from tappet.server.auth.login import FIRST_ACCOUNT, Login
from tappet.server.auth.one_time import OneTimeSecrets
from tappet.server.auth.passwords import Passwords
from tappet.server.builds.builder import Builder
from tappet.server.builds.commissioning import Commissioning
from tappet.server.builds.packages import PackageStore
from tappet.server.cams.calculator import CamCalculator
from tappet.server.cnc.calculator import CncCalculator
from tappet.server.comparisons.service import Comparisons
from tappet.server.database import Database
from tappet.server.debug.service import DebugVariants
from tappet.server.events.service import ProjectEvents
from tappet.server.metrics.service import Metrics
from tappet.server.online.quota import UserQuotas
from tappet.server.online.sampler import SamplerPool
from tappet.server.paths.service import PathViews
from tappet.server.runtimes.links import RuntimeLink, RuntimeRegistry
from tappet.server.runtimes.local import LocalRuntime
from tappet.server.runtimes.plc_client import Connect
from tappet.server.settings import LOCAL_RUNTIME, ServerSettings
from tappet.server.sockets import EndedSessions
from tappet.server.tables import runtimes as runtimes_table
from tappet.server.traces.service import Traces
from tappet.server.tuning.evaluator import MeasurementEvaluator
from tappet.server.unit_tests.service import TestRuns
from tappet.server.views.service import ViewRegistry
from tappet.whole_file import remove_unfinished

log = logging.getLogger(__name__)
HOUSEKEEPING_S = 3600.0
"""How often expired sessions and recordings are deleted; expired sessions are never accepted anyway."""
HOUSEKEEPER = "(server)"
"""Who deletes in the audit log; no account can be called so."""


@dataclass(slots=True)
class Services:
    """Everything that lives as long as the server."""

    settings: ServerSettings
    store: Store
    database: Database
    audit_reserve: AuditReserve
    passwords: Passwords
    one_time: OneTimeSecrets
    login: Login
    runtimes: RuntimeRegistry
    commissioning: Commissioning
    cams: CamCalculator
    cnc: CncCalculator
    debug: DebugVariants
    traces: Traces
    test_runs: TestRuns
    evaluator: MeasurementEvaluator = field(default_factory=MeasurementEvaluator)
    views: ViewRegistry = field(default_factory=ViewRegistry)
    ended_sessions: EndedSessions = field(default_factory=EndedSessions)
    comparisons: Comparisons = field(default_factory=Comparisons)
    quotas: UserQuotas = field(default_factory=UserQuotas)
    metrics: Metrics = field(default_factory=Metrics)
    first_account_token: str | None = field(default=None, repr=False)
    """Shown on the console at start-up while there is no account."""
    local_runtime: LocalRuntime | None = None
    _events: ProjectEvents | None = None
    _analysis: AnalysisService | None = None
    _paths: PathViews | None = None
    _housekeeping: asyncio.Task[None] | None = None
    _samplers: dict[RuntimeLink, SamplerPool] = field(default_factory=dict)

    @property
    def paths(self) -> PathViews:
        """Views of CNC paths, once the server has started."""
        assert self._paths is not None, "the server has started"
        return self._paths

    def samplers(self, link: RuntimeLink) -> SamplerPool:
        """The samplers of a runtime, shared by all who watch it."""
        for gone in [known for known in self._samplers if self.runtimes.find(known.id) is not known]:
            del self._samplers[gone]
        if link not in self._samplers:
            self._samplers[link] = SamplerPool(link)
        return self._samplers[link]

    @property
    def events(self) -> ProjectEvents:
        """The events sockets of projects, once the server has started."""
        assert self._events is not None, "the server has started"
        return self._events

    @property
    def analysis(self) -> AnalysisService:
        """The analysis of open projects, once the server has started."""
        assert self._analysis is not None, "the server has started"
        return self._analysis

    async def start(self) -> None:
        """Begins the work in the background."""
        self._housekeeping = asyncio.create_task(self._keep_house(), name="housekeeping")
        self._events = ProjectEvents(self.store)
        self._paths = PathViews(self.views, self.settings.data_dir / "objects")
        limits = Limits(self.settings.analysis_memory_mib, self.settings.analysis_seconds)
        self._analysis = AnalysisService(self.store, limits, idle_s=self.settings.analysis_idle_seconds)
        if self.settings.local_runtime:
            link = self.runtimes.add("Local", "", "", LOCAL_RUNTIME)
            folder = self.settings.data_dir / "runtime"
            options, pause = self.settings.local_runtime_options, self.settings.reconnect_seconds
            self.local_runtime = LocalRuntime(link, folder, options, pause)
        for row in await self.database.read_async(_stored_runtimes):
            self.runtimes.add(row.name, row.url, row.token, row.id)

    async def _keep_house(self) -> None:
        """Forgets what has expired."""
        while True:
            try:
                await asyncio.to_thread(self._tidy)
            except Exception:  # of a full disk, say: there is a next time
                log.exception("housekeeping failed; it is tried again in %g s", HOUSEKEEPING_S)
            await asyncio.sleep(HOUSEKEEPING_S)

    def _tidy(self) -> None:
        self.audit_reserve.prepare()
        self.audit_reserve.move(self.database)
        now = datetime.now(UTC)
        self.database.write(lambda db: sessions.remove_expired(db, self.settings, now))
        acts = [
            Act("recording-deleted", meta.title, str(meta.started_at), project_id=meta.project_id)
            for meta in self.traces.store.delete_expired(now)
        ]
        self.database.write(lambda db: write(db, HOUSEKEEPER, "", *acts))

    async def close(self) -> None:
        """Ends everything."""
        if self._events is not None:
            self._events.close()
        if self._housekeeping is not None:
            self._housekeeping.cancel()
        if self._analysis is not None:
            await self._analysis.close()
        await self.debug.close()
        await self.traces.close()
        await self.views.close()
        await self.commissioning.builder.close()
        await self.cams.close()
        await self.cnc.close()
        await self.evaluator.close()
        await self.runtimes.close()
        if self.local_runtime is not None:
            await self.local_runtime.close()
        self.store.close()


@dataclass(frozen=True, slots=True)
class _StoredRuntime:
    id: str
    name: str
    url: str
    token: str


def _stored_runtimes(db: Connection) -> list[_StoredRuntime]:
    c = runtimes_table.c
    rows = db.execute(select(c.id, c.name, c.url, c.token).order_by(c.created_at))
    return [_StoredRuntime(*row) for row in rows]


def open_services(settings: ServerSettings, connect: Connect) -> Services:
    """Opens the database, brings its schema up to date and puts the parts together. Blocks."""
    if settings.database_url is None:
        settings.data_dir.mkdir(parents=True, exist_ok=True, mode=0o700)
    store = Store(settings.url)
    database = Database(store.engine)
    passwords = Passwords(settings.password_cost)
    one_time = OneTimeSecrets()
    packages, objects = settings.data_dir / "packages", settings.data_dir / "objects"
    for folder in (packages, *objects.glob("??")):
        remove_unfinished(folder)
    commissioning = Commissioning(
        store,
        Builder(settings.build_workers, objects),
        PackageStore(packages),
    )
    services = Services(
        settings=settings,
        store=store,
        database=database,
        audit_reserve=AuditReserve(settings.data_dir),
        passwords=passwords,
        one_time=one_time,
        login=Login(database, passwords, one_time),
        runtimes=RuntimeRegistry(connect, settings.reconnect_seconds),
        commissioning=commissioning,
        cams=CamCalculator(objects),
        cnc=CncCalculator(objects),
        debug=DebugVariants(commissioning),
        traces=Traces(
            settings.data_dir / "recordings",
            settings.recordings_gib << 30,
            database,
            settings.recordings_keep,
        ),
        test_runs=TestRuns(commissioning.builder),
    )
    services.audit_reserve.try_move(database)
    if database.read(accounts.count) == 0:
        services.first_account_token = one_time.issue(FIRST_ACCOUNT)
    return services
