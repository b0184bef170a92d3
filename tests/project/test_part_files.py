"""Lines of files of a project folder are found from parts of objects: the texts say whether they are."""

from pathlib import Path

import pytest

from tappet.project import folder
from tappet.project.folder.part_files import part_files

PROJECTS = Path(__file__).parents[2] / "projects"


@pytest.mark.parametrize("name", sorted(path.name for path in PROJECTS.iterdir() if path.is_dir()))
def test_every_part_of_the_examples_stands_where_it_is_said_to_stand(name: str) -> None:
    project = folder.load(PROJECTS / name)
    found = part_files(project, PROJECTS / name)
    with_code = {item.id for item in project.walk() if getattr(item.data, "implementation", None)}
    assert with_code == {part.object_id for part in found if part.part == "implementation"}
    for part in found:
        text: str = getattr(project.get(part.object_id).data, part.part)
        lines = part.path.read_text(encoding="utf-8").split("\n")
        assert lines[part.line : part.line + part.count] == text.split("\n"), part


def test_a_file_written_by_hand(tmp_path: Path) -> None:
    folder.save(folder.load(PROJECTS / "bottling"), tmp_path)
    path = next(tmp_path.rglob("PLC_PRG.st"))
    head, body = path.read_text().split("END_VAR\n// Mode\n")
    path.write_text(f"{head}END_VAR\n\n\n// Mode\n{body}")
    project = folder.load(tmp_path)
    (part,) = (p for p in part_files(project, tmp_path) if p.path == path and p.part == "implementation")
    text: str = getattr(project.get(part.object_id).data, "implementation")  # noqa: B009
    assert path.read_text().split("\n")[part.line : part.line + part.count] == text.split("\n")
    assert "// Mode" in text
