"""A project to PLCopen XML and back is the same project, whatever its texts hold."""

from hypothesis import HealthCheck, given, settings
from project_strategies import projects

from tappet.project import edit
from tappet.project.exchange.importing import import_files
from tappet.project.exchange.plcopen_write import write_plcopen
from tappet.project.folder import encode
from tappet.project.model import Project
from tappet.project.new_project import new_project


def same(one: Project, other: Project) -> None:
    assert other.name == one.name
    assert other.description == one.description
    left = [(item.id, item.parent_id, item.kind, item.name, item.index, item.data) for item in one.walk()]
    right = [(item.id, item.parent_id, item.kind, item.name, item.index, item.data) for item in other.walk()]
    assert right == left


@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(projects())
def test_a_project_comes_back_as_it_was(project: Project) -> None:
    content = write_plcopen(project)
    imported = import_files({"export.xml": content}).project
    same(project, imported)
    assert write_plcopen(imported) == content
    assert encode(Project(project.name, project.description, project.objects)) == encode(imported)


def test_graphical_bodies_are_written_back_unchanged() -> None:
    project = new_project("Press")
    program = project.find_kind("pou")[0]
    kept = '<body><LD><leftPowerRail localId="0"><position x="0" y="0" /></leftPowerRail></LD></body>'
    foreign = '<Implementation><NWL>\n  <o n="x">a &amp; b</o></NWL></Implementation>'
    for text, language in ((kept, "LD"), (foreign, "FBD"), ("no XML & <", "SFC")):
        data = {"declaration": "PROGRAM PLC_PRG", "implementation": text, "language": language}
        changed = edit.change_data(project, program.id, data)
        content = write_plcopen(changed)
        same(changed, import_files({"x.xml": content}).project)
    assert kept.encode() in write_plcopen(
        edit.change_data(project, program.id, {"implementation": kept, "language": "LD"})
    )


def test_a_persistent_list_in_a_folder_takes_the_imported_variables() -> None:
    project = new_project("Press")
    (application,) = project.applications()
    project, folder = edit.add_object(project, application.id, "folder", "Lists")
    project, kept = edit.add_object(project, folder.id, "persistent")
    source = new_project("Other")
    source, _ = edit.add_object(source, source.applications()[0].id, "persistent", "More")
    (more,) = source.find_kind("persistent")
    text = "VAR_GLOBAL PERSISTENT RETAIN\n    nPieces : DINT;\nEND_VAR"
    content = write_plcopen(edit.change_data(source, more.id, {"declaration": text}))
    done = import_files({"other.xml": content}, into=project)
    (joined,) = done.project.find_kind("persistent")
    assert joined.id == kept.id
    assert "nPieces" in joined.data.model_dump()["declaration"]
    (entry,) = [entry for entry in done.report.entries if entry.object_id == kept.id]
    assert (entry.outcome, entry.object) == ("changed", "More")
