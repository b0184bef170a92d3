"""Attacks on the REST API, made by schemathesis from its OpenAPI document, as anybody or in a role.

Beside the checks of schemathesis, each answer is held against the role that the document names: who is below
it gets 403, who has not logged in 401, and nothing else.
"""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

import schemathesis
from live_server import RUNTIME, Script
from live_team import ROLES, Team
from schemathesis.config import SchemathesisConfig
from schemathesis.engine import events, from_schema
from schemathesis.generation.case import Case
from schemathesis.hooks import GLOBAL_HOOK_DISPATCHER, HookContext
from schemathesis.schemas import BaseSchema

NOBODY = "anybody"
PHASES = ("coverage", "fuzzing", "stateful")
AWAY = "urn:tappet:problem:runtime-not-connected"
"""Some make runtimes of addresses where none is."""
KNOWN = 0.8
"""How often a parameter of an address names what is there."""
PLACES = {
    "variable": ("body.expressions[*]", "body.values[*].expression", "query.path"),
    "runtime_id": ("body.runtime_id",),
    "object_id": ("body.parent_id",),
}
"""Where else than in addresses they are named."""


@dataclass
class Result:
    """What a series of requests found."""

    answers: Counter[int] = field(default_factory=Counter)
    served: Counter[str] = field(default_factory=Counter)
    """Answers with success, by operation."""
    finds: dict[tuple[str, str], str] = field(default_factory=dict)
    """The first of each kind of finding at each operation, with the request that repeats it."""

    def add(self, kind: str, operation: str, text: str) -> None:
        self.finds.setdefault((kind, operation), text)

    def report(self) -> str:
        found = [f"{kind}, {operation}:\n{text}" for (kind, operation), text in sorted(self.finds.items())]
        return "\n\n".join([f"{self.answers.total()} requests: {dict(self.answers)}", *found])


def attack(
    team: Team, role: str, *, seed: int, examples: int, phases: Sequence[str] = PHASES, operations: str = ""
) -> Result:
    """A series of requests; `operations` is a pattern of operation ids, if not all are asked."""
    result = Result()
    schema = _schema(team, seed=seed, examples=examples, phases=phases, operations=operations)
    with _logged_in(team, role):
        _collect(result, team, role, schema)
    return result


@contextmanager
def _logged_in(team: Team, role: str) -> Iterator[None]:
    """Gives each request the token of the role, a new one when the last request has ended it."""
    mine = str(team.boss.get("/auth/me")["id"])

    def before_call(context: HookContext, case: Case, kwargs: dict[str, Any]) -> None:
        for name, value in case.path_parameters.items():
            if value == mine:  # who restores what was broken stays
                case.path_parameters[name] = "nobody"
        if role in ROLES:
            case.headers["Authorization"] = f"Bearer {team.tokens[role]}"

    def after_call(context: HookContext, case: Case, response: Any) -> None:
        if response.status_code == 401 and role in ROLES and not team.is_in(role):
            team.login(role)

    hooks = (before_call, after_call)
    for hook in hooks:
        schemathesis.hook(hook)
    try:
        yield
    finally:
        for hook in hooks:
            GLOBAL_HOOK_DISPATCHER.unregister(hook)


def _collect(result: Result, team: Team, role: str, schema: BaseSchema) -> None:
    for event in from_schema(schema).execute():
        if isinstance(event, events.ScenarioFinished):
            changed = False
            for case, answer, failures in _requests(event):
                _judge(result, role, case, answer, failures)
                changed |= answer.status_code < 300 and case.method.upper() != "GET"
            if changed:
                team.restore()
                if not team.is_in(role):
                    team.login(role)
        elif isinstance(event, events.NonFatalError):
            result.add("error", event.label, event.info.format())
        elif isinstance(event, events.FatalError):
            raise AssertionError(str(event.exception))


def _requests(event: events.ScenarioFinished) -> Iterator[tuple[Case, Any, list[tuple[str, str]]]]:
    recorder = event.recorder
    for number, interaction in recorder.interactions.items():
        if interaction.response is None or number not in recorder.cases:
            continue
        failures = [
            (type(check.failure_info.failure).__name__, f"{check.failure_info.failure.message}")
            for check in recorder.checks.get(number, ())
            if check.failure_info is not None
        ]
        yield recorder.cases[number].value, interaction.response, failures


def _judge(result: Result, role: str, case: Case, answer: Any, failures: list[tuple[str, str]]) -> None:
    status, label = answer.status_code, case.operation.label
    result.answers[status] += 1
    if status < 300:
        result.served[label] += 1
    needed = _needed(case)
    if case.method.lower() == case.operation.method.lower() and needed is not None:
        if role == NOBODY:
            refused = status == 401
        elif ROLES.index(needed) > ROLES.index(role):
            # 401: the request before it ended the login; 400, 422: the body is no form, no JSON
            refused = status in (400, 401, 403) or (status == 422 and not _readable(case))
        else:
            refused = True
        if not refused:
            failures.append(("role", f"{role} got {status} where {needed} is needed"))
    if status == 503 and answer.json()["type"] == AWAY:
        failures = [(kind, text) for kind, text in failures if kind != "ServerError"]
    for kind, text in failures:
        result.add(kind, label, f"{text}\n{case.as_curl_command()}\n{status} {answer.content[:500]!r}")


def _readable(case: Case) -> bool:
    """Whether the body is what its media type says."""
    if not isinstance(case.body, bytes):
        return True
    try:
        json.loads(case.body)
    except ValueError:
        return False
    return True


def _needed(case: Case) -> str | None:
    """The role that the document names."""
    ways = case.operation.definition.raw["security"]
    return next((names[0] for way in ways for names in way.values()), None)


def _variables(boss: Script) -> Iterator[str]:
    for program in boss.get(f"{RUNTIME}/symbols"):
        for variable in boss.get(f"{RUNTIME}/symbols?path={program['path']}"):
            yield variable["path"]


def _shaded(document: Mapping[str, Any]) -> list[str]:
    """Addresses that another template of the document takes as well.

    `/objects/delete` is an object by its id to GET: `Allow` names more than the operations of the address.
    """
    paths = {path: path.split("/") for path in document["paths"]}

    def covers(general: list[str], special: list[str]) -> bool:
        return len(general) == len(special) and all(map(_takes, general, special))

    return [
        path
        for path, parts in paths.items()
        if any(path != other and covers(general, parts) for other, general in paths.items())
    ]


def _takes(general: str, special: str) -> bool:
    """Whether one part of an address is the same, or any."""
    return general == special or general.startswith("{")


def _schema(team: Team, *, seed: int, examples: int, phases: Sequence[str], operations: str) -> BaseSchema:
    boss = team.boss
    document = boss.get("/openapi.json")
    objects = boss.get(f"{boss.project}/objects")
    words = {
        "project_id": [team.project_id],
        "application_id": [team.application_id],
        "object_id": [one["id"] for one in objects],
        "runtime_id": ["local"],
        "variable": list(_variables(boss)),
        "task": [one["name"] for one in boss.get(f"{RUNTIME}/tasks")],
    }
    config = SchemathesisConfig.from_dict(
        {
            "seed": seed,
            "continue-on-failure": True,
            "request-timeout": 120,
            "warnings": False,
            "dictionaries": {name: {"values": values} for name, values in words.items()},
            "parameters": {
                place: {"dictionary": name, "probability": KNOWN}
                for name in words
                for place in (f"path.{name}", *PLACES.get(name, ()))
            },
            "generation": {
                "max-examples": examples,
                "deterministic": True,
                "database": "none",
                "no-shrink": True,
                "with-security-parameters": False,
            },
            "checks": {
                "ignored_auth": {"enabled": False},  # asked below for each answer, with the role
                "positive_data_acceptance": {"enabled": False},  # names that are taken, files that are none
            },
            "operations": [
                {
                    "include-path": _shaded(document),
                    "checks": {"allow_header_conformance": {"enabled": False}},
                },
                {  # name a revision, objects, a project that was deleted: what is new lacks them
                    "include-method": ["POST", "PUT", "PATCH"],
                    "checks": {"ensure_resource_availability": {"enabled": False}},
                },
            ],
            "phases": {name: {"enabled": name in phases} for name in ("examples", *PHASES)},
        }
    )
    schema = schemathesis.openapi.from_dict(document, config=config)
    schema.config.update(base_url=team.plant.origin)
    return schema.include(operation_id_regex=operations) if operations else schema
