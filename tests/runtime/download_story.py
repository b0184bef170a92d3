"""A soft PLC whose disk fills up; `test_download_on_full_disk` runs this on a disk of 512 KiB."""

from __future__ import annotations

import errno
import json
import sys
import time
from pathlib import Path

from plc_programs import MAIN, build

from tappet.codegen.package import CodePackage
from tappet.runtime.errors import DiskFullError
from tappet.runtime.plc import SoftPlc
from tappet.runtime.retain import LIVE


def version(step: int, kept: int) -> CodePackage:
    """Counts by `step`; `kept` words are remanent."""
    return build(
        f"""PROGRAM PLC_PRG
VAR n : DINT; END_VAR
VAR RETAIN k : ARRAY [1..{kept}] OF LWORD; END_VAR
n := n + {step};
k[1] := k[1] + 1;
END_PROGRAM
""",
        MAIN,
    )


def fill(disk: Path) -> Path:
    """Takes all room there is."""
    filler = disk / "filler"
    with filler.open("wb", buffering=0) as file:
        for size in (4096, 256, 1):
            try:
                while True:
                    file.write(bytes(size))
            except OSError as error:
                if error.errno != errno.ENOSPC:
                    raise
    return filler


def counted(plc: SoftPlc) -> int:
    """The counter of the running program."""
    ref = plc.symbols().resolve("PLC_PRG.n")
    return int.from_bytes(plc.read([(ref.offset, ref.size)])[0], "little", signed=True)


def goes_on(plc: SoftPlc) -> bool:
    """Whether cycles are run."""
    before, end = counted(plc), time.monotonic() + 30
    while counted(plc) == before and time.monotonic() < end:
        time.sleep(0.01)
    return counted(plc) > before


def refusal(plc: SoftPlc, package: CodePackage) -> str:
    """Why a download is refused."""
    try:
        plc.download(package.to_bytes())
    except DiskFullError as error:
        return str(error)
    return "it was not"


def story(disk: Path) -> dict[str, object]:
    """What happened."""
    first = version(1, 10)
    plc = SoftPlc(disk)
    plc.download(first.to_bytes())
    plc.start()
    files = sorted(path.name for path in disk.iterdir())
    boot = (disk / "boot.tappet").read_bytes()
    told: dict[str, object] = {"large": refusal(plc, version(2, 200_000))}
    told["kept"] = sorted(path.name for path in disk.iterdir()) == files
    filler = fill(disk)
    told["full"] = refusal(plc, version(2, 10))
    told["runs"] = goes_on(plc) and plc.state == "run"
    told["code"] = plc.info().code_id == first.code_id
    told["boot"] = (disk / "boot.tappet").read_bytes() == boot
    plc.stop()
    told["stopped"] = plc.state
    told["logged"] = any("could not be saved" in entry.message for entry in plc.log.since(0))
    filler.unlink()
    told["nothing left"] = sorted({path.name for path in disk.iterdir()} - set(files) - {"retain.saved"})
    told["then"] = refusal(plc, version(2, 10))
    plc.close()
    told["live"] = (disk / LIVE).stat().st_mode & 0o777
    return told


if __name__ == "__main__":
    print(json.dumps(story(Path(sys.argv[1]))))
