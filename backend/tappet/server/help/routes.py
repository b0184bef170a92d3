"""Help for words of the language, messages and views."""

from __future__ import annotations

from tappet.server.dependencies import Viewer
from tappet.server.help import pages
from tappet.server.help.shapes import HelpEntry, HelpPage
from tappet.server.routing import Router
from tappet.translation.language import Language

router = Router(prefix="/help", tags=["help"])


@router.get("")
def list_help_pages(who: Viewer, language: Language = "en") -> list[HelpEntry]:
    """All pages with what they are about, in a language; items of libraries have theirs in `/libraries`."""
    return pages.entries(language)


@router.get("/words/{word:path}")
def read_help_of_word(word: str, who: Viewer, language: Language = "en") -> HelpPage:
    """A keyword, operator, function or type of the language, in any case."""
    return pages.word_page(word, language)


@router.get("/messages/{code}")
def read_help_of_message(code: str, who: Viewer, language: Language = "en") -> HelpPage:
    """A message of the compiler by its code."""
    return pages.message_page(code, language)


@router.get("/views/{name}")
def read_help_of_view(name: str, who: Viewer, language: Language = "en") -> HelpPage:
    """A view of the workbench."""
    return pages.view_page(name, language)
