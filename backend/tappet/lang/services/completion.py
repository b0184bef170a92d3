"""What can be written at a position.

The kind of place decides: behind a dot members, behind a colon types, in a call its parameters, elsewhere
names and keywords. Names with the attribute 'hide' do not appear (spec LDEC-144, LPRG-24, LPRG-25).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from tappet.iec.words import ACCESS_SPECIFIERS, SECTION_FLAGS, STATEMENT_WORDS
from tappet.lang import ast, symbols
from tappet.lang import types as t
from tappet.lang.access import may_use
from tappet.lang.analysis.scope import AmbiguousSymbol, QualifiedSymbol
from tappet.lang.attributes import attribute
from tappet.lang.lexer import ID
from tappet.lang.services import describe
from tappet.lang.services.completion_calls import (
    argument_type,
    case_selector,
    initial_members,
    parameters,
    type_before,
    whole_call,
)
from tappet.lang.services.cursor import (
    Cursor,
    EnclosingCall,
    chain_before,
    cursor_at,
    enclosing_call,
    in_pragma,
    operand,
    region_at,
)
from tappet.lang.services.documents import Position
from tappet.lang.services.instruction_list import JUMPS, in_rows, label_proposals, operator_proposals
from tappet.lang.services.keywords import (
    ATTRIBUTES,
    DECLARATION_KEYWORDS,
    EXPRESSION_KEYWORDS,
    OBJECT_KEYWORDS,
    STATEMENT_SNIPPETS,
    TYPE_KEYWORDS,
)
from tappet.lang.services.operators import CONVERTIBLE, OPERATOR_HEADS
from tappet.lang.services.resolution import (
    Meaning,
    Scope,
    block_members,
    block_of,
    callable_pou,
    enum_values,
    hides_locals,
    is_hidden,
    is_local,
    members,
    resolve,
    scope_at,
)
from tappet.lang.services.results import Completion, ItemKind
from tappet.lang.services.workspace import View, Workspace

_VALUE_BEFORE = frozenset(
    [":=", "=", "<>", "(", ",", "[", "+", "-", "*", "/", "AND", "OR", "XOR", "NOT", "=>"]
)
_STATEMENT_BEFORE = frozenset(
    [";", "THEN", "ELSE", "DO", "REPEAT", ":", "OF", "END_VAR", "__TRY", "__FINALLY"]
)
_USUAL = ("BOOL", "INT", "DINT", "REAL", "LREAL", "TIME", "STRING", "BYTE", "WORD", "DWORD", "UINT", "UDINT")
"""Types that come first."""


def complete(workspace: Workspace, document: str, position: Position) -> list[Completion]:
    """The proposals at a position, best first. What is typed of a word already does not filter them."""
    return proposals(workspace.quick_view(document, position))


def proposals(view: View) -> list[Completion]:
    """The proposals at the position of a view, best first."""
    cursor = cursor_at(view.lexed, view.position)
    if cursor.inside != "code":
        if cursor.inside == "pragma" and in_pragma(cursor):
            return [Completion(name, ItemKind.ATTRIBUTE, detail, insert=name) for name, detail in ATTRIBUTES]
        return []
    found = {(item.label.upper(), item.kind): item for item in reversed(list(_proposals(view, cursor)))}
    return sorted(found.values(), key=lambda item: (item.rank, item.order, item.label.upper()))


def _proposals(view: View, cursor: Cursor) -> Iterator[Completion]:
    lexed = view.lexed
    before = lexed.kinds[cursor.previous] if cursor.previous >= 0 else ""
    scope = scope_at(view)
    if before == ".":
        yield from _members(view, scope, cursor)
        return
    region = region_at(lexed, cursor.previous)
    previous_word = lexed.texts[cursor.previous].upper() if cursor.previous >= 0 else ""
    if previous_word in ("EXTENDS", "IMPLEMENTS"):
        yield from _bases(view, previous_word)
        return
    if _wants_type(view, cursor, region, before):
        yield from _types(view)
        return
    if region == "outside":
        yield from _keywords(OBJECT_KEYWORDS, 3)
        return
    if region == "head":
        if before in ("FUNCTION_BLOCK", "PROGRAM", "FUNCTION", "METHOD"):
            return
        yield from _keywords(("EXTENDS", "IMPLEMENTS"), 3)
        yield from _keywords(DECLARATION_KEYWORDS, 4)
    if region in ("variables", "type") and not _in_initial_value(view, cursor):
        flagged = previous_word.startswith("VAR") or previous_word in SECTION_FLAGS
        words: tuple[str, ...] = SECTION_FLAGS if flagged else ("END_VAR", "AT")
        if previous_word == "VAR":
            words += ACCESS_SPECIFIERS
        yield from _keywords(words, 4)
        return
    yield from _code(view, scope, cursor, before, region)


def _code(view: View, scope: Scope, cursor: Cursor, before: str, region: str) -> Iterator[Completion]:
    """In a body: what fits the type that is expected, parameters, names, operators, keywords."""
    call = enclosing_call(view.lexed, view.source, cursor.previous)
    if call is not None and before in ("(", ","):
        yield from parameters(scope, call, before == "(")
    if before in ("(", ","):
        yield from initial_members(view, scope, cursor.previous)
    if in_rows(view.unit, view.position.line):
        yield from _row(view, scope, cursor)
        return
    expected = _expected_type(view, scope, cursor, before, call)
    if isinstance(expected, t.Enum):
        yield from _enum(view, expected, 0)
    elif isinstance(expected, t.Elementary) and expected.kind is t.Kind.BOOL:
        yield from _keywords(("TRUE", "FALSE"), 2)
    if before in (";", "OF", "") or before.startswith("END_"):
        selected = case_selector(view, scope, cursor.previous)
        if selected is not None:
            values = _enum(view, selected[0], 0 if before == "OF" else 2)
            yield from (item for item in values if item.label.rpartition(".")[2].upper() not in selected[1])
    at_statement = before in _STATEMENT_BEFORE or before.startswith("END_") or before == ""
    yield from _names(scope, expected, at_statement and call is None, cursor.word)
    if at_statement and call is None:
        for label, text, detail in STATEMENT_SNIPPETS:
            yield Completion(label, ItemKind.SNIPPET, detail, insert=text, snippet=True, rank=6)
        yield from _keywords(STATEMENT_WORDS, 7)
        if region == "code":
            yield from _keywords(DECLARATION_KEYWORDS, 8)
    elif before not in _VALUE_BEFORE:
        yield from _keywords(STATEMENT_WORDS, 7)
    yield from _keywords(EXPRESSION_KEYWORDS, 7)
    yield from _operators(cursor.word.upper())


def _row(view: View, scope: Scope, cursor: Cursor) -> Iterator[Completion]:
    """In a row of IL: instructions and functions in front, labels behind JMP, operands elsewhere (IL-01)."""
    lexed = view.lexed
    previous = cursor.previous
    if previous < 0 or lexed.lines[previous] != view.position.line or lexed.kinds[previous] == ":":
        yield from operator_proposals()
        yield from _operators(cursor.word.upper())
    elif lexed.texts[previous].upper() in JUMPS:
        yield from label_proposals(view.unit, view.position.line)
        return
    yield from _names(scope, None, False, cursor.word)
    yield from _keywords(("TRUE", "FALSE"), 7)


def _keywords(words: Iterable[str], rank: int) -> Iterator[Completion]:
    for word in words:
        yield Completion(word, ItemKind.KEYWORD, rank=rank)


# -- members


def _members(view: View, scope: Scope, cursor: Cursor) -> Iterator[Completion]:
    start = chain_before(view.lexed, cursor.previous)
    if start == cursor.previous:  # `.name`: the global namespace
        for symbol in view.snapshot.analysis.scope.values():
            if _offered(symbol):
                yield _item(symbol, 3)
        return
    meaning = resolve(scope, operand(view.lexed, view.source, start, cursor.previous))
    block = block_of(meaning.type)
    own = block is not None and scope.block is not None and block is scope.block
    begin = view.lexed.kinds[start - 1] if start else ""
    writes = begin in _STATEMENT_BEFORE or begin.startswith("END_") or begin == ""
    of_library = block is not None and block.source is not None and block.source.library is not None
    without_locals = hides_locals(block) or writes or of_library
    order = 0
    for symbol in members(meaning).values():
        if isinstance(symbol, (AmbiguousSymbol, QualifiedSymbol)) or is_hidden(symbol):
            continue
        foreign = not own and is_local(symbol) and isinstance(meaning.type, t.FunctionBlock)
        if foreign and without_locals:  # from outside, locals can be read at most
            continue
        if not may_use(symbol, scope.block, view.source):
            continue
        yield _item(symbol, _member_rank(symbol, meaning), order)
        order += 1
        call = whole_call(symbol, symbol.name, 4, writes) if isinstance(symbol, symbols.PouSymbol) else None
        if call is not None:
            yield call
    if isinstance(meaning.type, t.Elementary) and meaning.type.is_integer:
        for bit in range(8 * meaning.type.size):
            yield Completion(str(bit), ItemKind.FIELD, "BOOL", rank=6)
    elif isinstance(meaning.type, t.Pointer):
        yield Completion(
            "^",
            ItemKind.OPERATOR,
            f"{meaning.type.base or ''}",
            "What the pointer points to.",
            rank=2,
            over=1,
        )


def _member_rank(symbol: symbols.Symbol, meaning: Meaning) -> int:
    """Inputs and outputs of an instance first, then what can be called, what is inside last."""
    if isinstance(symbol, symbols.VarSymbol) and isinstance(meaning.type, t.FunctionBlock):
        return 7 if is_local(symbol) else 1 if symbol.section == "VAR_INPUT" else 2
    return 3


def _item(symbol: symbols.Symbol, rank: int, order: int = 0) -> Completion:
    pragmas: list[ast.Pragma] = []
    if isinstance(symbol, symbols.PouSymbol) and symbol.pou is not None:
        pragmas = symbol.pou.attributes
    elif isinstance(symbol, symbols.TypeSymbol):
        decl = getattr(symbol.type, "decl", None)
        pragmas = decl.attributes if isinstance(decl, ast.TypeDecl) else []
    return Completion(
        symbol.name,
        describe.kind_of(symbol),
        describe.short(symbol),
        describe.comment_of(symbol),
        rank=rank,
        order=order,
        deprecated=attribute(pragmas, "obsolete") is not None,
        library=describe.library_of(symbol),
    )


def _offered(symbol: symbols.Symbol) -> bool:
    if symbol.access == "INTERNAL" and symbol.source is not None and symbol.source.library is not None:
        return False
    return not isinstance(symbol, (AmbiguousSymbol, QualifiedSymbol)) and not is_hidden(symbol)


# -- names


def _names(scope: Scope, expected: t.Type | None, statement: bool, word: str) -> Iterator[Completion]:
    """What is seen by its plain name; instances and functions with their parameters as well."""
    seen: set[str] = set()
    for key, symbol in scope.locals.items():
        seen.add(key)
        if symbol.name and _offered(symbol):
            yield _item(symbol, _rank(symbol, expected, 3, 1))
            call = whole_call(symbol, symbol.name, 3, True) if statement else None
            if call is not None:
                yield call
    for key, symbol in block_members(scope.block).items():
        if symbol.name and key not in seen and _offered(symbol):
            seen.add(key)
            yield _item(symbol, 3)
    if scope.block is not None and scope.block.kind == "FUNCTION_BLOCK":
        yield Completion("THIS^", ItemKind.KEYWORD, scope.block.name, "The own instance.", rank=6)
        if scope.block.base is not None:
            yield Completion("SUPER^", ItemKind.KEYWORD, scope.block.base.name, "The base block.", rank=6)
    for key, symbol in scope.snapshot.analysis.scope.items():
        if key not in seen and _offered(symbol):
            library = symbol.source is not None and symbol.source.library is not None
            rank = _rank(symbol, expected, 6 if library else 4, 2)
            yield _item(symbol, rank)
            # Long lists of calls help only those who have begun to write a name.
            call = whole_call(symbol, symbol.name, rank, statement) if word else None
            if call is not None and (statement or isinstance(symbol, symbols.PouSymbol)):
                yield call


def _rank(symbol: symbols.Symbol, expected: t.Type | None, rank: int, fitting: int) -> int:
    """What has the very type that is expected comes first."""
    if expected is not None and isinstance(symbol, symbols.VarSymbol) and symbol.type == expected:
        return fitting
    return rank


def _operators(word: str) -> Iterator[Completion]:
    for name, (head, text) in OPERATOR_HEADS.items():
        yield Completion(name, ItemKind.OPERATOR, head, text, rank=8)
    if word.startswith("TO_"):
        for target in CONVERTIBLE:
            yield Completion(f"TO_{target}", ItemKind.OPERATOR, f"TO_{target}(IN : ANY) : {target}", rank=8)
    source = word.partition("_")[0]
    if "_" in word and source in CONVERTIBLE:
        for target in CONVERTIBLE:
            if target != source:
                name = f"{source}_TO_{target}"
                yield Completion(name, ItemKind.OPERATOR, f"{name}(IN : {source}) : {target}", rank=8)


def _enum(view: View, type_: t.Enum, rank: int) -> Iterator[Completion]:
    named = view.snapshot.analysis.scope.get((type_.name or "").upper())
    path = named.choice if isinstance(named, QualifiedSymbol) else type_.name
    for order, value in enumerate(enum_values(type_).values()):
        assert isinstance(value, symbols.EnumValueSymbol)
        plain = view.snapshot.analysis.scope.get(value.name.upper())
        bare = isinstance(plain, symbols.EnumValueSymbol) and plain.type is type_
        label = value.name if bare else f"{path}.{value.name}"
        detail = f"{type_.name} = {value.number}"
        library = describe.library_of(named) if named is not None else ""
        yield Completion(
            label, ItemKind.ENUM_VALUE, detail, value.comment, rank=rank, order=order, library=library
        )


# -- calls


def _expected_type(
    view: View, scope: Scope, cursor: Cursor, before: str, call: EnclosingCall | None
) -> t.Type | None:
    """The type expected at the place, as far as the tokens before it determine it."""
    lexed = view.lexed
    if before in ("IF", "ELSIF", "WHILE", "UNTIL", "NOT", "AND", "OR"):
        return t.BOOL
    if before == "FOR":
        return t.INT
    if before in ("(", ",") and call is not None:
        return argument_type(scope, call)
    if before not in (":=", "=", "<>"):
        return None
    name = cursor.previous - 1
    if before == ":=" and call is not None and name > call.opening and lexed.kinds[name] is ID:
        pou = callable_pou(resolve(scope, call.callee))
        if pou is not None:
            for variable in describe.pins(pou):
                if variable.name.upper() == lexed.texts[name].upper():
                    return variable.type
            return None
    return type_before(view, scope, cursor.previous)


# -- types


def _wants_type(view: View, cursor: Cursor, region: str, before: str) -> bool:
    lexed = view.lexed
    at = cursor.previous
    if before == "TO":
        return at > 0 and lexed.kinds[at - 1] in ("POINTER", "REFERENCE")
    if before == "OF":
        return at > 0 and lexed.kinds[at - 1] == "]" and region in ("variables", "type", "head")
    return before == ":" and region in ("variables", "type", "head")


def _in_initial_value(view: View, cursor: Cursor) -> bool:
    """Whether the place belongs to the value behind ':=' of a declaration."""
    for at in range(cursor.previous, -1, -1):
        kind = view.lexed.kinds[at]
        if kind == ":=":
            return True
        if kind in (";", ":") or kind.startswith(("VAR", "END_")) or kind in ("STRUCT", "UNION", "TYPE"):
            return kind == ":" and view.lexed.kinds[cursor.previous] in ("[", "..", "(")
    return False


def _types(view: View) -> Iterator[Completion]:
    for symbol in view.snapshot.analysis.scope.values():
        if not _offered(symbol):
            continue
        library = symbol.source is not None and symbol.source.library is not None
        block = isinstance(symbol, symbols.PouSymbol) and symbol.kind == "FUNCTION_BLOCK"
        if block or isinstance(symbol, (symbols.TypeSymbol, symbols.InterfaceSymbol)):
            yield _item(symbol, 4 if library else 3)
        elif isinstance(symbol, symbols.NamespaceSymbol):
            yield _item(symbol, 6)
    for name in sorted({type_.name for type_ in t.ELEMENTARY.values()} | {"TOD", "DT", "STRING", "WSTRING"}):
        if not name.startswith("__"):
            order = _USUAL.index(name) if name in _USUAL else len(_USUAL)
            yield Completion(name, ItemKind.TYPE, "elementary", rank=2, order=order)
    for label, text in TYPE_KEYWORDS:
        yield Completion(label, ItemKind.KEYWORD, insert=text, snippet=True, rank=5)


def _bases(view: View, word: str) -> Iterator[Completion]:
    """Blocks, interfaces or structures, by the word and by what is being declared."""
    heads = [k for k in view.lexed.kinds if k in ("FUNCTION_BLOCK", "INTERFACE", "TYPE")]
    head = heads[0] if heads else "FUNCTION_BLOCK"
    for symbol in view.snapshot.analysis.scope.values():
        if isinstance(symbol, symbols.InterfaceSymbol):
            fits = word == "IMPLEMENTS" or head == "INTERFACE"
        elif isinstance(symbol, symbols.PouSymbol):
            fits = word == "EXTENDS" and head == "FUNCTION_BLOCK" and symbol.kind == "FUNCTION_BLOCK"
        elif isinstance(symbol, symbols.TypeSymbol):
            fits = word == "EXTENDS" and head == "TYPE" and isinstance(symbol.type, t.Struct)
        else:
            fits = isinstance(symbol, symbols.NamespaceSymbol)
        if fits and _offered(symbol):
            yield _item(symbol, 3)
