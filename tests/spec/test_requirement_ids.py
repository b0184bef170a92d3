"""Every requirement that the code cites is in `docs/requirements`, and every "DESIGN" it cites in `docs`."""

import json
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
REQUIREMENTS = ROOT / "docs" / "requirements"
ROW = re.compile(r'^\| <a id="[a-z0-9-]+"></a>([A-Z][A-Z0-9]*-\d+[a-z]?) \| (.+) \|$', re.MULTILINE)
SOURCES = (".py", ".st", ".ts", ".tsx", ".csv", ".css")
FOLDERS = ("backend", "frontend/src", "tests", "projects", "plugins", ".ci")


def documented() -> dict[str, list[str]]:
    """The documents of each ID."""
    found: dict[str, list[str]] = {}
    for path in sorted(REQUIREMENTS.glob("*.md")):
        for key, text in ROW.findall(path.read_text(encoding="utf-8")):
            assert len(text) > 10, f"{path.name}: {key} says nothing"
            found.setdefault(key, []).append(path.stem)
    return found


def language_cases() -> set[str]:
    """The IDs of the language examples, such as `CONV-03`."""
    data = json.loads((ROOT / "tests/spec/data/language_examples.json").read_text(encoding="utf-8"))
    return set(re.findall(r'"id": "([A-Z]+-\d+)"', json.dumps(data)))


DOCUMENTED = documented()
KNOWN = DOCUMENTED.keys() | language_cases()
FAMILIES = "|".join(sorted({key.rsplit("-", 1)[0] for key in KNOWN}, key=lambda key: (-len(key), key)))
CITED = re.compile(rf"(?<![\w-])((?:{FAMILIES})-\d{{2,3}}[a-z]?)(?![\w-])")


def texts() -> Iterator[tuple[Path, str]]:
    """The sources of the project that people write."""
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix in SOURCES and path.name != "schema.ts" and "node_modules" not in path.parts:
                yield path.relative_to(ROOT), path.read_text(encoding="utf-8")


def test_there_are_requirements() -> None:
    assert len(DOCUMENTED) > 1500


@pytest.mark.parametrize("name", sorted(path.stem for path in REQUIREMENTS.glob("*.md")))
def test_an_id_is_there_once_in_a_document(name: str) -> None:
    found = [key for key, _ in ROW.findall((REQUIREMENTS / f"{name}.md").read_text(encoding="utf-8"))]
    assert sorted(set(found)) == sorted(found)
    assert found or name == "README"


def test_cited_requirements_are_documented() -> None:
    unknown = [
        f"{path}: {key}"
        for path, text in texts()
        for key in sorted(set(CITED.findall(text)))
        if key not in KNOWN
    ]
    assert unknown == []


def test_an_example_is_cited_with_its_document() -> None:
    """`EX-06` alone would be one of twenty examples of that number."""
    cited = re.compile(r"(?:\b(\w+)[ ,])?\b(EX-\d+(?:(?:, | and )EX-\d+)*)")
    wrong = [
        f"{path}: {document} {key}"
        for path, text in texts()
        if path.name != Path(__file__).name
        for document, keys in cited.findall(text)
        for key in keys.replace(" and ", ", ").split(", ")
        if document not in DOCUMENTED.get(key, ())
    ]
    assert wrong == []


def test_cited_design_is_in_the_repository() -> None:
    wrong = [
        str(path)
        for path, text in texts()
        if re.search(r"\bDESIGN\b", text) and path.name != Path(__file__).name
    ]
    assert wrong == []
