"""Paths of lists in libraries: what browsing finds, reading finds as well."""

from __future__ import annotations

from tests.project.cam_projects import package, with_cams

from tappet.codegen.build import BuildOptions, build_application
from tappet.codegen.symbol_map import SymbolMap
from tappet.iec.task import Task
from tappet.lang.source import Scope, Source
from tappet.runtime.local import LocalRuntime

SIZES = "VAR_GLOBAL\n    nSize : INT := {};\nEND_VAR"


def walked(symbols: SymbolMap) -> dict[str, str]:
    """Paths two levels deep with their types, each found again by its path."""
    found = {}
    for root in symbols.children():
        for child in symbols.children(root.path):
            ref = symbols.resolve(child.path)
            assert (ref.path, ref.type.name) == (child.path, child.type)
            found[child.path] = child.type
            if not child.leaf:
                symbols.children(child.path)
    return found


def test_lists_of_a_library_within_a_library_have_paths() -> None:
    found = walked(package(with_cams(Cam=None)).symbols)
    assert found["SM3_Trajectory.Constants.PI"] == "LREAL"
    assert found["SM3_Basic.Constants.MAX_PASSED_TAPPETS"] == "INT"
    assert found["IoConfig_Cam.Cam"] == "MC_CAM_REF"


def test_lists_of_one_name_keep_apart() -> None:
    """In the application and in libraries, one with a namespace that is the name of another one."""
    body = """PROGRAM Main
VAR
    n : INT;
END_VAR
n := Sizes.nSize + 10 * One.Sizes.nSize + 100 * Second.Sizes.nSize + 1000 * Third.Sizes.nSize;
END_PROGRAM"""
    sources = [
        Source("main.st", body, scope=Scope.APPLICATION),
        Source("sizes.st", SIZES.format(1), scope=Scope.APPLICATION, name="Sizes"),
        *(
            Source(
                f"{name}.st", SIZES.format(value), Scope.LIBRARY, name="Sizes", library=name, namespace=space
            )
            for name, space, value in (("One", "One", 2), ("Two", "Second", 3), ("Second", "Third", 4))
        ),
    ]
    result = build_application(sources, [Task("Task", programs=("Main",))], options=BuildOptions(level=1))
    assert [str(d) for d in result.diagnostics] == []
    assert result.package is not None
    found = walked(result.package.symbols)
    paths = [path for path in found if path.endswith("nSize")]
    assert len(paths) == 4
    with LocalRuntime(result.package) as plc:
        plc.start()
        plc.run(2)
        assert plc.read("Main.n") == 4321
        assert sorted(plc.read(path) for path in paths) == [1, 2, 3, 4]
