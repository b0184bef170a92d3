"""Lines of words to G-code text. Spec CNC-92."""

from __future__ import annotations

from tappet.cnc.words import Line, Program, Word


def number_text(value: float) -> str:
    """The shortest text that reads back as the same number; without an exponent where that is possible."""
    if value.is_integer() and abs(value) < 1e15:
        return f"{value:.0f}"
    short = repr(value)
    if "e" not in short:
        return short
    digits = f"{value:.25f}".rstrip("0")
    return digits if float(digits) == value else short


def word_text(word: Word) -> str:
    """A word."""
    return f"{word.address}{number_text(word.value) if word.variable is None else f'${word.variable}$'}"


def line_text(line: Line) -> str:
    """A line, comments behind it."""
    if line.header is not None:
        return f"% {line.header}"
    parts = [f"N{line.number}"] if line.number is not None else []
    parts += [word_text(word) for word in line.words]
    parts += [f"({comment})" if ")" not in comment else f"//{comment}" for comment in line.comments]
    return ("/" if line.suppressed else "") + " ".join(parts)


def program_text(program: Program) -> str:
    """A program."""
    return "\n".join(line_text(line) for line in program.lines)
