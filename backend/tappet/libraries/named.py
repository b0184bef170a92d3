"""The library texts that a program can reach: as a linker takes from an archive what is named.

An index holds the identifiers of every library text and the names that it makes known. A text is taken when
something taken before names one of its names; texts with data of their own (variable lists, programs, static
variables), exported functions and check functions are always taken, so that the memory of an application does
not depend on what is left out. The index is made once, by content, and kept in the user's cache folder.

Nothing is left out of libraries that have messages of their own or depend on the application. A program with
errors is to be analysed with everything: messages propose names that exist.
"""

from __future__ import annotations

import hashlib
import json
import re
from collections import OrderedDict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from tappet.iec.identifiers import identifiers
from tappet.iec.languages import languages
from tappet.iec.tokens import code_of
from tappet.lang.source import Source
from tappet.user_cache import cache_folder, compiler_stamp, store

FORMAT = 2
KEPT = 8
"""Indexes in memory."""
_ALWAYS = re.compile(
    r"\b(?:VAR_GLOBAL|VAR_STAT|PROGRAM)\b|\bCheck(?:Bounds|Div|L?Range|Pointer)|\{[^}]*tappet_(?:export|cycle_start)",
    re.IGNORECASE,
)
_CONVERSION = "Conversion"
"""Library whose functions stand behind the conversion operators, which do not name them."""
_CONVERTS = re.compile(r"(?:^|[_ ])TO_")
"""In upper-case identifiers, separated by spaces."""


@dataclass(slots=True)
class Index:
    """What the texts of some libraries name and make known, in the order of the texts."""

    everything: bool
    """Nothing may be left out."""
    always: list[bool]
    names: list[str]
    """Upper-case names that a text makes known, separated by spaces."""
    identifiers: list[str]
    """Upper-case identifiers in a text, separated by spaces."""

    def to_bytes(self) -> bytes:
        """For the cache: a check sum and JSON."""
        data = json.dumps([FORMAT, self.everything, self.always, self.names, self.identifiers]).encode()
        return hashlib.blake2b(data, digest_size=16).digest() + data

    @classmethod
    def from_bytes(cls, content: bytes, texts: int) -> Index | None:
        """The index of so many texts; None when it is damaged or of another format."""
        check, data = content[:16], content[16:]
        if hashlib.blake2b(data, digest_size=16).digest() != check:
            return None
        try:
            version, everything, always, names, identifiers = json.loads(data)
        except ValueError:
            return None
        if version != FORMAT or not len(always) == len(names) == len(identifiers) == texts:
            return None
        return cls(everything, always, names, identifiers)


_kept: OrderedDict[str, Index] = OrderedDict()


def named_texts(
    libraries: Sequence[Source], own: Iterable[Source], index: Index | None = None
) -> list[Source]:
    """The texts of `libraries` that a program of the texts `own` can reach, in their order.

    A text of a library sees that library and those it uses; the application sees all, but one whose names
    need the namespace (LIB-08) only where it writes the namespace.
    """
    index = index or index_of(libraries)
    if index.everything:
        return list(libraries)
    declared: dict[str, dict[str, list[int]]] = {}
    for number, names in enumerate(index.names):
        of_library = declared.setdefault(_label(libraries[number]), {})
        for name in names.split():
            of_library.setdefault(name, []).append(number)
    written = {name for source in own for name in identifiers(source.text)}
    written.update(name for source in libraries for one in source.given for name in identifiers(one.value))
    taken = [False] * len(libraries)
    waiting: list[tuple[Iterable[str], set[str]]] = [(_seen(libraries, written), written)]

    def take(number: int, names: str = "") -> None:
        source = libraries[number]
        taken[number] = True
        seen = (_label(source), *(use.label.upper() for use in source.uses))
        waiting.append((seen, {*index.identifiers[number].split(), *names.split()}))
        if _CONVERTS.search(index.identifiers[number]):
            take_conversions()

    def take_conversions() -> None:
        while conversions:
            number = conversions.pop()
            if not taken[number]:
                take(number, index.names[number])

    conversions = [number for number, source in enumerate(libraries) if source.library == _CONVERSION]
    if _CONVERTS.search(" ".join(written)):
        take_conversions()
    for number in range(len(libraries)):
        if index.always[number] and not taken[number]:
            take(number, index.names[number])
    while waiting:
        labels, found = waiting.pop()
        for of_library in [declared[label] for label in labels if label in declared]:
            for name in found.intersection(of_library):
                for number in of_library.pop(name):
                    if not taken[number]:
                        take(number)
    return [source for source, wanted in zip(libraries, taken, strict=True) if wanted]


def _label(source: Source) -> str:
    """What the library of a text is known by to those that use it, upper case (`Use.label`)."""
    return (source.namespace or source.library or "").upper()


def _seen(libraries: Iterable[Source], written: set[str]) -> list[str]:
    """The libraries of which an application that writes these identifiers sees names."""
    spelled: dict[str, set[str]] = {}
    for source in libraries:
        spelled.setdefault(_label(source), {_label(source), (source.library or "").upper()})
        for use in source.uses:
            spelled.setdefault(use.label.upper(), {use.label.upper()}).add(use.name.upper())
    qualified = {_label(source) for source in libraries if source.qualified_only}
    return [label for label, names in spelled.items() if label not in qualified or names & written]


def index_of(libraries: Sequence[Source]) -> Index:
    """The index of these texts: kept in memory, read from the cache, or made."""
    key = _key(libraries)
    return _at_hand(key, len(libraries)) or _make(key, libraries)


def known_index(libraries: Sequence[Source]) -> Index | None:
    """The index of these texts if it need not be made."""
    return _at_hand(_key(libraries), len(libraries))


def _at_hand(key: str, texts: int) -> Index | None:
    found = _kept.get(key)
    if found is None:
        folder = cache_folder("libraries")
        try:
            content = (folder / key).read_bytes() if folder is not None else b""
        except OSError:
            return None
        found = Index.from_bytes(content, texts)
        if found is not None:
            _keep(key, found)
    return found


def _make(key: str, libraries: Sequence[Source]) -> Index:
    found = _made(libraries)
    folder = cache_folder("libraries")
    if folder is not None:
        store(folder / key, found.to_bytes())
    _keep(key, found)
    return found


def _keep(key: str, index: Index) -> None:
    _kept[key] = index
    while len(_kept) > KEPT:
        _kept.popitem(last=False)


def _key(libraries: Sequence[Source]) -> str:
    digest = hashlib.blake2b(f"{FORMAT}|{compiler_stamp()}|".encode(), digest_size=20)
    for source in libraries:
        head: tuple[Any, ...] = (source.uri, source.owner, source.name, source.library, source.namespace)
        head = (
            *head,
            source.qualified_only,
            source.uses,
            source.private,
            source.given,
            source.bodies,
            len(source.text),
        )
        digest.update(f"{head!r}\n{source.text}".encode("utf-8", "surrogatepass"))
    return digest.hexdigest()


def _made(libraries: Sequence[Source]) -> Index:
    """The index, made by an analysis of the libraries for themselves."""
    from tappet.lang.analysis import AnalysisOptions, analyse
    from tappet.lang.analysis.edits.identifiers import identifiers_of
    from tappet.lang.analysis.libraries import read_program

    results, shared = read_program(libraries, AnalysisOptions())
    silent = shared is not None and not any(result.diagnostics for result in results)
    if not silent or analyse([], libraries=shared).diagnostics:
        return Index(True, [True] * len(results), [""] * len(results), [""] * len(results))
    implicit = tuple(one.implicit_names for one in languages().values() if one.implicit_names)
    always, names, words = [], [], []
    for result in results:
        source = result.unit.source
        read = code_of(source.text)
        made = identifiers_of(result.unit).global_names | ({source.owner.upper()} if source.owner else set())
        hidden = any(name.startswith(implicit) for name in made)
        always.append(hidden or _ALWAYS.search(read) is not None)
        names.append(" ".join(sorted(made)))
        words.append(" ".join(sorted(identifiers(read))))
    return Index(False, always, names, words)
