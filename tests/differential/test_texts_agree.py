"""STRING_TO_<type> of random texts, good and bad: a text means what it means as a literal in a program.

Source: LOPR-76. The texts are built here with the value they have; of changed ones the front end reports
whether they are literals. What no literal is gives 0; integers of any size are cut to the target.
"""

from __future__ import annotations

import re
from random import Random
from typing import Any

import typed_tree as tree
from arithmetic import convert, same, wrap
from linked_application import LoadedApplication
from seeds import seeds
from typed_tree import BOOL, INTEGERS, LREAL, REAL, Scalar

from tappet.codegen.build import BuildOptions, BuildSession, build_application
from tappet.iec.literals import decode
from tappet.lang.source import Source

SESSION = BuildSession()
CLOCKS = {
    "time": (tree.TIME, tree.LTIME),
    "date": (tree.DATE, tree.LDATE),
    "tod": (tree.TOD, tree.LTOD),
    "dt": (tree.DT, tree.LDT),
}
UNITS = (("d", 86400 * 10**9), ("h", 3600 * 10**9), ("m", 60 * 10**9), ("s", 10**9), ("ms", 10**6))
FINE_UNITS = (*UNITS, ("us", 1000), ("ns", 1))


def case(r: Random, text: str) -> str:
    return r.choice((text, text, text.lower(), text.upper()))


def whole(r: Random) -> str:
    """An integer."""
    value = r.choice((0, 1, 9, 127, 128, 255, 500, 32768, 70000, 2**31, 2**32, 2**63, 2**64 - 1, 2**64))
    value = r.choice((value, r.getrandbits(r.randint(1, 64))))
    digits = {2: f"{value:b}", 8: f"{value:o}", 10: str(value), 16: f"{value:x}"}
    base = r.choice((10, 10, 10, 2, 8, 16))
    text = digits[base]
    if len(text) > 1 and r.random() < 0.2:
        place = r.randint(1, len(text) - 1)
        text = text[:place] + "_" + text[place:]
    return (
        r.choice(("", "", "-", "+")) + (f"{base}#" if base != 10 or r.random() < 0.1 else "") + case(r, text)
    )


def decimal(r: Random) -> str:
    """A number with a point or an exponent."""
    text = r.choice(("0", "1", "12", "1_000", "340282356", "179769313486231580", str(r.getrandbits(40))))
    text += r.choice(("", ".0", ".5", ".25", ".000_1", f".{r.getrandbits(20)}"))
    text += r.choice(("", "", "e3", "E-2", "e+30", "e38", "E-46", "e300", "e-330"))
    return r.choice(("", "", "-", "+")) + text


def duration(r: Random) -> str:
    prefix = r.choice(("T", "TIME", "LTIME", "LT"))
    units = FINE_UNITS if prefix[0] == "L" or r.random() < 0.1 else UNITS
    chosen = sorted(r.sample(range(len(units)), r.randint(1, 3)))
    parts = [f"{r.choice((0, 1, 5, 23, 59, 60, 999, 1000, 40000))}{units[i][0]}" for i in chosen]
    if r.random() < 0.2:
        unit = units[chosen[-1]][0]
        parts[-1] = f"{r.randint(0, 59)}.{r.choice(('5', '25', '001', '000001', '1234567'))}{unit}"
    return case(r, f"{prefix}#{r.choice(('', '', '_')).join(parts)}")


def day(r: Random) -> str:
    year = r.choice((1970, 1999, 2000, 2001, 2024, 2100, 2106, 2107, 2400, 2554, 2555, 1969))
    return f"{year}-{r.choice((1, 2, 6, 12, 13)):02}-{r.choice((1, 9, 21, 28, 29, 30, 31, 32)):02}"


def clock(r: Random) -> str:
    text = f"{r.choice((0, 9, 23, 24)):02}:{r.choice((0, 30, 59, 60)):02}"
    if r.random() < 0.8:
        text += f":{r.choice((0, 1, 59, 60)):02}"
        text += r.choice(("", "", ".5", ".123", ".1230", ".0005", ".123456789"))
    return text


def good(r: Random, kind: str) -> str:
    if kind == "time":
        return duration(r)
    if kind == "whole":
        return whole(r)
    if kind == "decimal":
        return decimal(r)
    if kind == "date":
        return case(r, f"{r.choice(('D', 'DATE', 'LD', 'LDATE'))}#{day(r)}")
    if kind == "tod":
        return case(r, f"{r.choice(('TOD', 'TIME_OF_DAY', 'LTOD', 'LTIME_OF_DAY'))}#{clock(r)}")
    prefix = r.choice(("DT", "DATE_AND_TIME", "LDT", "LDATE_AND_TIME"))
    return case(r, f"{prefix}#{day(r)}-{clock(r)}")


def changed(r: Random, text: str) -> str:
    """One letter removed, added or replaced."""
    place = r.randrange(len(text)) if text else 0
    letter = r.choice("0159-+:.#_eTsdmhx ")
    return text[:place] + r.choice(("", letter, letter + text[place : place + 1])) + text[place + 1 :]


KINDS = ("whole", "decimal", "time", "date", "tod", "dt")


def number(text: str) -> Any:
    """Value of a number without type, None for anything else."""
    body = text[1:] if text[:1] in ("-", "+") else text
    if not body or not body[0].isdigit():
        return None
    found = decode(body)
    if found.kind not in ("int", "real") or found.prefix or found.value is None:
        return None
    return -found.value if text[0] == "-" else found.value  # type: ignore[operator]


def meaning(text: str, target: Scalar) -> Any:
    """What the conversion gives."""
    body = text.strip(" ")
    if target == BOOL:
        return text == "TRUE"
    value = number(body)
    if target.integer:
        return wrap(value, target) if isinstance(value, int) else 0
    if target.kind == "real":
        if value is None and body.replace("_", "").lstrip("+-").isdigit():
            value = number(body + ".0")  # more than an integer holds
        if value is None or "#" in body:
            return 0.0
        if target == REAL and abs(value) > 3.4028235677973362e38:
            return 0.0
        return convert(-float(-value) if body[0] == "-" else float(value), target)
    family = next(k for k, types in CLOCKS.items() if target in types)
    if "#" not in body or not body[0].isalpha():
        return 0
    long = body[0] in "Ll"
    found = decode(body if long else "L" + body)  # how late it may be is up to the target
    if found.value is None or found.kind.removeprefix("l") != family:
        return 0
    assert isinstance(found.value, int)
    if not long and family in ("time", "tod") and (found.value % 10**6 or "us" in body or "ns" in body):
        return 0
    result = found.value // target.unit_ns
    return result if result <= target.high else 0


def settled(text: str, target: Scalar) -> bool:
    """Whether the rules say what a text means: `.5`, `5.` and `16#FF` as real number are left open, and
    underscores in exponents, and in times elsewhere than between two parts."""
    if target.kind == "real" and "_" in text.lower().partition("e")[2]:
        return False
    if "." in text and target.kind == "real":
        before, _, after = text.strip(" ").lstrip("+-").partition(".")
        return before[:1].isdigit() and after[:1].isdigit()
    if target.kind == "time":
        return "_" not in re.sub(r"[a-zA-Z]_(?=\d)", "", text)
    return "__" not in text


TARGETS = (BOOL, *INTEGERS, REAL, LREAL, *(t for pair in CLOCKS.values() for t in pair))


def check(seed: int, level: int, count: int = 60) -> None:
    r = Random(seed)
    cases: list[tuple[str, Scalar]] = []
    while len(cases) < count:
        kind = r.choice(KINDS)
        text = good(r, kind)
        for _ in range(r.choice((0, 0, 1, 2))):
            text = changed(r, text)
        fitting = CLOCKS.get(kind, (*INTEGERS, REAL, LREAL))
        target = r.choice(fitting if r.random() < 0.9 else TARGETS)
        if settled(text, target):
            cases.append((text, target))
    cases += [(text, BOOL) for text in ("TRUE", "true", "FALSE", "1", "TRUE ")]
    texts = "".join(f"s{i} : STRING := '{text}'; v{i} : {t.name}; " for i, (text, t) in enumerate(cases))
    body = "\n".join(f"v{i} := STRING_TO_{t.name}(s{i});" for i, (_, t) in enumerate(cases))
    source = Source("a.st", f"PROGRAM PLC_PRG\nVAR {texts}END_VAR\n{body}\nEND_PROGRAM")
    result = build_application([source], (), BuildOptions(level=level), session=SESSION)
    assert [str(d) for d in result.diagnostics if d.severity == "error"] == []
    assert result.package is not None
    application = LoadedApplication(result.package)
    try:
        application.start()
        application.cycle()
        found = [application.read(f"PLC_PRG.v{i}") for i in range(len(cases))]
    finally:
        application.close()
    wrong = [
        f"STRING_TO_{t.name}('{text}'): expected {wanted!r}, got {value!r}"
        for (text, t), value in zip(cases, found, strict=True)
        if not same(wanted := meaning(text, t), value)
    ]
    assert not wrong, "\n".join([f"seed {seed}", *wrong])


@seeds(3, range(1000, 1200))
def test_texts(seed: int, level: int) -> None:
    """LOPR-76."""
    check(seed, level)
