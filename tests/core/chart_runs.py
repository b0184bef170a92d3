"""Charts that the tests call from the outside, on virtual time, 10 ms apart."""

from __future__ import annotations

from linked_application import LoadedApplication

from tappet.codegen.build import BuildOptions, BuildSession, build_application
from tappet.lang.source import Source

SESSION = BuildSession()
CYCLE_NS = 10_000_000


class Run:
    """A built program, called from the outside."""

    def __init__(self, *texts: str) -> None:
        sources = [Source(f"text{number}", text) for number, text in enumerate(texts)]
        result = build_application(sources, session=SESSION, options=BuildOptions(level=1))
        errors = [str(d) for d in result.diagnostics if d.severity == "error"]
        assert errors == []
        assert result.package is not None
        self.application = LoadedApplication(result.package)
        self.application.start()
        self.calls = 0

    def call(self, times: int = 1) -> None:
        for _ in range(times):
            self.application.cycle()
            self.application.clock_ns += CYCLE_NS
            self.calls += 1

    def __getitem__(self, path: str) -> str:
        return self.application.literal(path if "." in path.split("#")[0] and path[0] == "!" else f"P.{path}")

    def __setitem__(self, path: str, literal: str) -> None:
        self.application.write(f"P.{path}", literal)

    def active(self, path: str, calls: int) -> list[int]:
        """Numbers of the calls, from 1, at whose end a BOOL is TRUE."""
        found = []
        for _ in range(calls):
            self.call()
            if self[path] == "TRUE":
                found.append(self.calls)
        return found


def chart(steps: str, variables: str = "", head: str = "PROGRAM P") -> str:
    return f"{head}\nVAR\n call_ : INT;\n {variables}\nEND_VAR\n{steps}\nEND_{head.split()[0]}"
