"""What "Add object" makes compiles as it is, each template of each kind (GVL-02, DUT-02, PERS-02)."""

from tappet.lang.analysis import AnalysisOptions, analyse
from tappet.lang.parser import parse
from tappet.project import edit
from tappet.project.kind_registry import kinds
from tappet.project.model import Project
from tappet.project.new_project import new_project
from tappet.project.sources import application_sources

PLAIN = ("function", "program")


def everything() -> Project:
    """A new project with one new object of every template that an application can hold."""
    project = new_project("x")
    (application,) = project.applications()
    for kind in kinds().values():
        places = kind.placement.parents
        if "application" not in places or kind.naming.style == "fixed" or kind.name == "application":
            continue
        if kind.name in (
            "axis_group",
            "cam",
            "cnc",
        ):  # of types of libraries: test_axis_groups, test_cams, test_cnc_code
            continue
        for subkind in (*kind.templates,) or (None,):
            project, added = edit.add_object(project, application.id, kind.name, subkind=subkind)
            for child in ("method", "property", "action"):
                if added.kind in kinds()[child].placement.parents and added.subkind not in (
                    "function",
                    "program",
                ):
                    project, _ = edit.add_object(project, added.id, child)
    return project


def test_templates_compile() -> None:
    project = everything()
    (application,) = project.applications()
    texts = application_sources(project, application.id)
    assert len(texts) > 15
    units = []
    for text in texts:
        parsed = parse(text)
        assert [found.message for found in parsed.diagnostics] == [], text.text
        units.append(parsed.unit)
    found = analyse(units, AnalysisOptions()).diagnostics
    assert [(item.uri, item.message) for item in found if item.severity == "error"] == []
