"""Building and running small programs in the tests of this room."""

from __future__ import annotations

import ctypes

from linked_application import LoadedApplication

from tappet.codegen.build import BuildOptions, BuildResult, BuildSession, build_application
from tappet.codegen.package import CodePackage, left_behind, rearranged
from tappet.lang.source import Source

SESSION = BuildSession()


def build(text: str, previous: CodePackage | None = None, **options: object) -> CodePackage:
    return result(text, previous, **options).package_or_fail()


class Result:
    def __init__(self, inner: BuildResult) -> None:
        self.inner = inner

    def package_or_fail(self) -> CodePackage:
        errors = [str(d) for d in self.inner.diagnostics if d.severity == "error"]
        assert errors == []
        assert self.inner.package is not None
        return self.inner.package


def result(text: str, previous: CodePackage | None = None, **options: object) -> Result:
    settings = BuildOptions(**options)  # type: ignore[arg-type]
    return Result(build_application([Source("test.st", text)], (), settings, previous, SESSION))


def change_over(application: LoadedApplication, package: CodePackage) -> LoadedApplication:
    """What a runtime does with an online change; the image of the new application keeps the old address."""
    change = package.online_change
    assert change is not None
    size = application.package.image_size
    for function in left_behind(application.package, package):
        application.call(function)
    before = bytes(application.image[:size])
    image = rearranged(package, before)
    changed = LoadedApplication(package, application.address)
    ctypes.memmove(changed.address, bytes(image), package.image_size)
    if "tappet.online_change" in package.exports:
        changed.call("tappet.online_change")
    return changed
