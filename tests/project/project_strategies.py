"""Projects for property tests: real edits with names and texts chosen to be awkward."""

from hypothesis import strategies as st

from tappet.project import edit
from tappet.project.errors import ProjectError
from tappet.project.model import Project, new_id
from tappet.project.new_project import new_project
from tappet.project.objects import make_object

FREE_NAMES = st.sampled_from(
    ["Motors", "CON", "aux", "电机 1", "50 %", "a:b", "Größe", "x" * 200, "ü" * 200, "index", "~", "%41"]
) | st.text(max_size=12)
IDENTIFIERS = st.sampled_from(["FB_Motor", "Con", "AUX", "index", "fb_motor", "x" * 200, "_a"])
PROJECT_NAMES = st.sampled_from(["Press", "Press 1.2", "电机", "a/b: <c>", "CON", "..", "x" * 200])
PIECES = st.sampled_from(
    [
        "PROGRAM P",
        "FUNCTION_BLOCK FB EXTENDS Base\n  IMPLEMENTS I, J",
        "METHOD PUBLIC m : INT",
        "TYPE T :",
        "FUNCTION F",
        "UNION",
        "END_UNION",
        "VAR_INPUT CONSTANT",
        "VAR_IN_OUT CONSTANT",
        "x : FB(1, y := 2);",
        "GET",
        "ACTION x",
        "VAR",
        "VAR_INPUT",
        "END_VAR",
        "x : INT;",
        "x := 1;",
        "END_PROGRAM",
        "END_FUNCTION_BLOCK",
        "END_METHOD",
        "END_ACTION",
        "END_GET",
        "END_PROPERTY",
        "(*",
        "*)",
        "// note",
        "// === IMPLEMENTATION ===",
        "{attribute 'x'}",
        "{attribute 'no_return_type'}",
        "{x = y}",
        "TIME_TO_REAL(t)",
        "'",
        "\n",
        "\n\n",
        " ",
        "\t",
        "\ufeff",
        "\r\n",
        "电",
    ]
)
TEXTS = st.lists(PIECES, max_size=12).map("".join) | st.text(
    st.characters(exclude_characters="\x00", exclude_categories=["Cs"]), max_size=40
)
JSON_VALUES = st.recursive(
    st.none()
    | st.booleans()
    | st.integers(-(2**60), 2**60)
    | st.floats(allow_nan=False, allow_infinity=False)
    | st.text(),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(), inner, max_size=3),
    max_leaves=6,
)
KINDS = st.sampled_from(
    [
        "folder",
        "pou",
        "pou",
        "method",
        "action",
        "property",
        "interface",
        "dut",
        "gvl",
        "persistent",
        "task",
        "device",
    ]
)


def _data(draw: st.DrawFn, kind: str) -> dict[str, object] | None:
    declaration = draw(TEXTS)
    if kind in ("pou", "method", "accessor"):
        texts = {"declaration": declaration, "implementation": draw(TEXTS)}
        return texts | {"exclude_from_build": draw(st.booleans())}
    if kind == "action":
        return {"implementation": draw(TEXTS), "exclude_from_build": draw(st.booleans())}
    if kind in ("property", "interface", "dut", "gvl", "persistent"):
        return {"declaration": declaration, "exclude_from_build": draw(st.booleans())}
    if kind == "device":
        return {"description": draw(TEXTS), "simulated": draw(st.booleans())}
    return None


def _split_data() -> st.SearchStrategy[dict[str, object]]:
    """Data of a missing plug-in that say which of them are text files, rightly or not."""
    endings = st.dictionaries(
        st.sampled_from(["a", "b", "$texts"]), st.sampled_from(["md", "st", "json", "É"])
    )
    fields = st.dictionaries(st.sampled_from(["a", "b", "c"]), TEXTS | JSON_VALUES)
    return st.builds(lambda data, texts: data | {"$texts": texts}, fields, endings | JSON_VALUES)


@st.composite
def projects(draw: st.DrawFn) -> Project:
    """A sound project; most of its texts do not compile."""
    project = new_project(draw(PROJECT_NAMES), draw(TEXTS))
    for _ in range(draw(st.integers(0, 8))):
        parent = draw(st.sampled_from([item.id for item in project.walk()]) | st.none())
        kind = draw(KINDS)
        name = draw(FREE_NAMES if kind in ("folder", "device") else IDENTIFIERS)
        data = draw(st.none() | st.just("texts"))
        try:
            project, added = edit.add_object(project, parent, kind, name)
            if data is not None and (texts := _data(draw, kind)) is not None:
                project = edit.change_data(project, added.id, texts)
        except ProjectError:
            continue
    if draw(st.booleans()):
        application = draw(st.sampled_from(project.applications()))
        rules = draw(
            st.dictionaries(st.sampled_from(["S1001", "S1211"]), st.sampled_from(["warning", "error"]))
        )
        analysis = {"rules": rules, "prefixes": {"FUNCTION_BLOCK": "fb"}, "limits": {"nesting": 2}}
        off = draw(st.lists(st.sampled_from(["W1001", "W1122", "W1208"])))
        chosen = {"static_analysis": analysis, "disabled_warnings": off}
        project = edit.change_data(project, application.id, chosen)
    for item in project.find_kind("accessor"):
        project = edit.change_data(project, item.id, _data(draw, "accessor") or {})
    if draw(st.booleans()):
        curve = make_object(
            id=new_id(),
            parent_id=draw(st.sampled_from([item.id for item in project.walk()])),
            kind="oscillogram",
            name="Curve",
            index=0,
            data=draw(st.dictionaries(st.text(), JSON_VALUES, max_size=4) | _split_data()),
        )
        objects = {**project.objects, curve.id: curve}
        siblings = [
            item for item in Project("", objects=objects).children(curve.parent_id) if item.id != curve.id
        ]
        for index, sibling in enumerate([*siblings, curve]):
            objects[sibling.id] = sibling.model_copy(update={"index": index})
        project = Project(project.name, project.description, objects)
    return project
