"""A global variable under another name in the texts that use it (AXIS-04).

By the words of the texts, without an analysis, so that a project that does not compile can be refactored too.
A word is the variable where nothing stands before it, or the list that holds it; not as a member of something
else, not as a parameter in a call, not in a text that declares the name itself or belongs to one that does,
and not in comments and strings. Names that a base block of a library declares are not known here.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise

from tappet.iec.languages import language_of
from tappet.iec.tokens import Word, words
from tappet.project.data import BodyData, CodeData, DeclarationData
from tappet.project.model import Project, ProjectObject
from tappet.project.naming import name_key
from tappet.project.objects import changed_object

_ASSIGNED = frozenset((":=", "=>"))
_SECTIONS = ("VAR", "VAR_")


def users_renamed(
    project: Project, items: Iterable[ProjectObject], lists: Sequence[str], names: Mapping[str, str]
) -> list[ProjectObject]:
    """The objects of `items` whose texts use variables, with their new `names`, by the old ones; `lists` are
    the variable lists that hold them."""
    holders = frozenset(name_key(name).upper() for name in lists)
    changed = []
    for item in items:
        if not isinstance(item.data, CodeData):
            continue
        used = {old: new for old, new in names.items() if not _declares(project, item, old)}
        update = {}
        for field in _texts(item):
            before = text = getattr(item.data, field)
            for old, new in used.items():
                text = renamed(text, holders, old, new)
            if text != before:
                update[field] = text
        if update:
            changed.append(changed_object(item, data=item.data.model_copy(update=update)))
    return changed


def renamed(text: str, holders: frozenset[str], old: str, new: str) -> str:
    """A text with the uses of a variable under its new name; `holders` are lists in capitals."""
    wanted = old.upper()
    if wanted not in text.upper():
        return text
    found = list(words(text))
    depth = 0
    done = 0
    pieces = []
    for number, word in enumerate(found):
        if word.text in ("(", "["):
            depth += 1
        elif word.text in (")", "]"):
            depth -= 1
        elif word.text == wanted and _is_use(found, number, depth, holders):
            pieces += [text[done : word.start], new]
            done = word.end
    return "".join([*pieces, text[done:]])


def _is_use(found: Sequence[Word], number: int, depth: int, holders: frozenset[str]) -> bool:
    before = found[number - 1].text if number else ""
    if before == ".":
        return number > 1 and found[number - 2].text in holders
    behind = found[number + 1].text if number + 1 < len(found) else ""
    return not (depth > 0 and behind in _ASSIGNED)


def _texts(item: ProjectObject) -> list[str]:
    """The fields of the data that are IEC texts."""
    if isinstance(item.data, BodyData):
        known = language_of(item.data.language)
        text = known.form_of(item.data.implementation) == "text"
        return ["declaration", "implementation"] if text else ["declaration"]
    return ["declaration"] if isinstance(item.data, DeclarationData) else []


def _declares(project: Project, item: ProjectObject, name: str) -> bool:
    """Whether an object, or one that it belongs to, declares a variable of this name."""
    return any(
        name.upper() in _declared(one.data.declaration)
        for one in (item, *project.ancestors(item.id))
        if isinstance(one.data, BodyData | DeclarationData)
    )


def _declared(declaration: str) -> set[str]:
    """The names in the sections of variables, in capitals."""
    names = set()
    inside = False
    found = list(words(declaration))
    for word, behind in pairwise(found):
        if word.text.startswith(_SECTIONS):
            inside = True
        elif word.text == "END_VAR":
            inside = False
        elif inside and behind.text in (":", ",", "AT"):
            names.add(word.text)
    return names
