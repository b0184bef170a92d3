"""Chinese texts use the words of docs/vocabulary.md."""

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TABLE = ROOT / "docs" / "vocabulary.md"
CHINESE = re.compile(r"[\u4e00-\u9fff]+")


def _refused() -> dict[str, str]:
    """Words that are not used, each with the one that is."""
    rows = [
        line.strip("| \n").split("|") for line in TABLE.read_text("utf-8").splitlines() if line[:2] == "| "
    ]
    words = {}
    for row in rows[1:]:
        cells = [cell.strip() for cell in row]
        if len(cells) == 3:
            words |= dict.fromkeys(CHINESE.findall(cells[2]), cells[1])
    return words


def _texts() -> list[Path]:
    front_end = [
        path
        for path in (ROOT / "frontend" / "src").rglob("*.json")
        if "zh" in path.parts or path.stem == "zh"
    ]
    back_end = [
        path for path in (ROOT / "backend").rglob("*") if path.suffix in (".py", ".csv", ".json", ".txt")
    ]
    return front_end + [path for path in back_end if CHINESE.search(path.read_text("utf-8"))]


def test_one_word_for_one_thing() -> None:
    refused, texts = _refused(), _texts()
    assert len(refused) > 10
    assert len(texts) > 15
    found = [
        f"{path.relative_to(ROOT)}:{number}: {word}, say {use}"
        for path in texts
        for number, line in enumerate(path.read_text("utf-8").splitlines(), 1)
        for word, use in refused.items()
        if word in line
    ]
    assert found == []
