"""What docstrings and documents name in backticks exists: modules, files, functions."""

from __future__ import annotations

import ast
import re
import tomllib
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
BACKEND = ROOT / "backend" / "tappet"
PACKAGES = sorted(BACKEND.rglob("__init__.py"))
TEXTS = sorted(
    [
        ROOT / "README.md",
        ROOT / "CONTRIBUTING.md",
        *(ROOT / "docs").glob("*.md"),
        *(ROOT / "docs/security").glob("*.md"),
    ]
)

_SPAN = re.compile(r"(?<!`)`([^`\n]+)`(?!`)")
_DOTTED = re.compile(r"[a-z_]\w*(?:\.\w+)*\Z")
_PATH = re.compile(r"[\w.-]+(?:/[\w.-]+)+/?\Z")
_LINK = re.compile(r"\]\(([^)#:]+)\)")

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
_GROUPS = {"tappet.kinds", "tappet.languages", "tappet.operations"}
"""Entry-point groups, which packages name and which are no modules."""

_FILES = (".st", ".json", ".csv", ".txt")


@cache
def _names(path: Path) -> frozenset[str]:
    """What a module defines or imports, and the fields and methods of its classes."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)):
            found.add(node.name)
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            found.add(node.id)
        elif isinstance(node, ast.alias):
            found.add((node.asname or node.name).rpartition(".")[2])
        elif isinstance(node, ast.arg):
            found.add(node.arg)
    return frozenset(found)


def _leads_to(folder: Path, parts: list[str]) -> bool:
    """Whether dotted names lead from a package to a package, a module, a file of it, or a name in it."""
    if not parts:
        return True
    head, rest = parts[0], parts[1:]
    if (folder / head).is_dir():
        return _leads_to(folder / head, rest)
    module = folder / f"{head}.py"
    if module.is_file():
        return not rest or rest[0] in _names(module)
    package = folder / "__init__.py"
    return package.is_file() and head in _names(package)


def _exists(name: str, package: Path) -> bool:
    if name.endswith(_FILES):
        return any(package.rglob(name))
    parts = name.removeprefix("tappet.").split(".")
    folders = [package, *package.parents]
    inside = folders[: folders.index(BACKEND) + 1]
    return any(_leads_to(folder, parts) for folder in inside) or any(
        name in _names(module) or name == module.stem for module in package.rglob("*.py")
    )


def _wrong_in(package: Path, text: str) -> list[str]:
    named = [span for span in _SPAN.findall(text) if _DOTTED.match(span)]
    return [name for name in named if name not in _GROUPS and not _exists(name, package)]


@pytest.mark.parametrize("path", PACKAGES, ids=lambda path: str(path.parent.relative_to(BACKEND)))
def test_the_docstring_of_a_package_names_what_exists_in_five_lines(path: Path) -> None:
    text = ast.get_docstring(ast.parse(path.read_text(encoding="utf-8"))) or ""
    assert text, "a package says what lives here, what it may import and where to start"
    assert len(text.splitlines()) <= 5
    assert _wrong_in(path.parent, text) == []


_WORD = re.compile(r"[A-Za-z_]\w*")
EXAMPLES = {
    *("wanted_1", "wanted_2", "f_arguments", "iqr", "idx", "base.3", "x.3", "dataclasses.asdict"),
    *("__getX", "__setX", "__getName", "__setName", "__GETX", "__SETX"),
}
"""Examples of names, and names of Python's own library."""


@cache
def _used() -> frozenset[str]:
    """Every name that the code defines or uses, words of its texts and its files included; no docstrings."""
    found: set[str] = set()
    for path in BACKEND.rglob("*.*"):
        found |= {path.name, path.stem}
        if path.suffix in (".st", ".json"):
            found.update(_WORD.findall(path.read_text(encoding="utf-8")))
        elif path.suffix == ".py":
            found.update(path.relative_to(BACKEND).parts[:-1])
            found |= _used_in(path)
    return frozenset(found)


def _used_in(path: Path) -> set[str]:
    found: set[str] = set()
    tree = ast.parse(path.read_text(encoding="utf-8"))
    documented = {id(text) for text, _ in _texts(tree)}
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in documented:
            found.update(_WORD.findall(node.value))
        else:
            named = (getattr(node, field, None) for field in ("id", "attr", "arg", "name"))
            found.update(part for name in named if isinstance(name, str) for part in name.split("."))
    return found


def _texts(tree: ast.AST) -> Iterator[tuple[ast.Constant, str]]:
    for node in ast.walk(tree):
        value = node.value if isinstance(node, ast.Expr) else None
        if isinstance(value, ast.Constant) and isinstance(value.value, str):
            yield value, value.value


def test_docstrings_name_what_exists() -> None:
    gone = []
    for path in BACKEND.rglob("*.py"):
        for constant, text in _texts(ast.parse(path.read_text(encoding="utf-8"))):
            for span in _SPAN.findall(text):
                known = (
                    span in EXAMPLES or span in _used() or all(part in _used() for part in span.split("."))
                )
                if _DOTTED.match(span) and not known:
                    gone.append(f"{path.relative_to(BACKEND)}:{constant.lineno}: {span}")
    assert gone == []


def test_a_module_that_is_gone_is_found() -> None:
    assert _wrong_in(BACKEND / "codegen", "Start with `build`, then `emit_gone` and `lang.rules.gone`.") == [
        "emit_gone",
        "lang.rules.gone",
    ]


def _files_named(text: str) -> set[str]:
    """Paths between backticks that begin with a folder or a package of this repository."""
    known = {path.name for path in (*ROOT.iterdir(), *BACKEND.iterdir()) if path.is_dir()}
    paths = {span for span in _SPAN.findall(text) if _PATH.match(span)}
    return {path for path in paths if path.split("/")[0] in known}


@pytest.mark.parametrize("path", TEXTS, ids=lambda path: path.name)
def test_a_document_names_files_and_links_that_exist(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    places = (ROOT, BACKEND, path.parent)
    gone = [name for name in _files_named(text) if not any((place / name).exists() for place in places)]
    gone += [link for link in _LINK.findall(text) if not (path.parent / link).exists() and "/" in link]
    assert gone == []


def test_the_layout_in_the_architecture_lists_the_packages() -> None:
    text = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    block = text[text.index("Imports run one way") :].split("\n\n")[1]
    listed = re.findall(r"^    (\w+)", block, re.MULTILINE)
    packages = {path.parent.name for path in BACKEND.glob("*/__init__.py")}
    assert set(listed) - {"frontend"} == packages


LOADED_BY_NAME = {
    "confusable_homoglyphs": "importlib.resources, for its table",
    "psycopg": "SQLAlchemy, from the address",
    "python_multipart": "FastAPI, for uploads",
}
"""Dependencies without an import, and what loads them."""
IMPORTED_AS = {"argon2_cffi": "argon2", "google_re2": "re2", "pillow": "PIL", "pyelftools": "elftools"}


@pytest.mark.parametrize("entry", PROJECT["project"]["dependencies"])
def test_every_dependency_is_imported(entry: str) -> None:
    name = re.split(r"[\[<>=]", entry)[0].replace("-", "_")
    module = IMPORTED_AS.get(name, name)
    imports = re.compile(rf"^\s*(?:import|from) {module}\b", re.MULTILINE)
    assert name in LOADED_BY_NAME or any(
        imports.search(path.read_text(encoding="utf-8")) for path in BACKEND.rglob("*.py")
    )
