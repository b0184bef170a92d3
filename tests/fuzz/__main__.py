"""`python -m tests.fuzz NAME --seconds 300`: a long run, guided by coverage where atheris is installed.

Without atheris, or with --words, words of the seeds are changed at random. Finds are written to --to.
"""

from __future__ import annotations

import argparse
import secrets
import signal
import sys
import tempfile
import time
import traceback
from pathlib import Path
from random import Random

sys.path[:0] = [str(Path(__file__).parent), str(Path(__file__).parents[1] / "programs")]


class TooSlowError(Exception):
    """One input takes longer than it may."""


def _alarm(*_: object) -> None:
    raise TooSlowError


def by_words(name: str, seconds: float, folder: Path, start: int) -> int:
    from targets import TARGETS

    target = TARGETS[name]
    print(f"{name}: inputs from --start {start}", flush=True)
    corpus = target.seeds()
    signal.signal(signal.SIGALRM, _alarm)
    end, number, found, seen = time.monotonic() + seconds, start, 0, set()
    while time.monotonic() < end:
        data = target.mutate(Random(number), corpus)
        number += 1
        signal.alarm(target.limit_s)
        try:
            target.run(data)
        except Exception as error:
            place = traceback.extract_tb(error.__traceback__)[-1]
            key = (type(error).__name__, place.filename, place.lineno)
            if key not in seen:
                seen.add(key)
                found += 1
                (folder / f"{name}-{number - 1}").write_bytes(data)
                print(f"{name} {number - 1}: {error!r} at {place.filename}:{place.lineno}", flush=True)
        finally:
            signal.alarm(0)
    target.finish()
    print(f"{name}: {number - start} inputs, {found} finds")
    return found


def by_coverage(name: str, seconds: int, folder: Path) -> None:
    import atheris

    with atheris.instrument_imports(include=["tappet.lang", "tappet.project", "tappet.runtime.protocol"]):
        from targets import TARGETS
    target = TARGETS[name]
    with tempfile.TemporaryDirectory() as corpus:
        for number, data in enumerate(target.seeds()):
            (Path(corpus) / str(number)).write_bytes(data)
        flags = [
            f"-max_total_time={seconds}",
            f"-timeout={target.limit_s}",
            f"-artifact_prefix={folder}/",
            "-rss_limit_mb=4096",
        ]
        atheris.Setup([sys.argv[0], *flags, corpus], target.run)
        atheris.Fuzz()


def close_doors() -> None:
    from door_targets import close

    close()


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("name")
    options.add_argument("--seconds", type=int, default=300)
    options.add_argument("--to", type=Path, default=Path(tempfile.gettempdir()))
    options.add_argument("--words", action="store_true")
    options.add_argument("--start", type=int, help="number of the first input, to repeat a run")
    given = options.parse_args()
    if given.start is None:
        given.start = secrets.randbelow(1 << 32)
    given.to.mkdir(parents=True, exist_ok=True)
    if not given.words:
        try:
            import atheris  # noqa: F401
        except ImportError:
            print("atheris is not installed: words of the seeds are changed at random")
            given.words = True
    if given.words or given.name.startswith("door-"):  # what is behind a door is in another process
        try:
            found = by_words(given.name, given.seconds, given.to, given.start)
        finally:
            close_doors()
        sys.exit(found > 0)
    by_coverage(given.name, given.seconds, given.to)


if __name__ == "__main__":
    main()
