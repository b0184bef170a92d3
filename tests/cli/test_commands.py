"""The command line as others script against it: outputs, formats and exit codes."""

from __future__ import annotations

import csv
import json
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
BOTTLING = ROOT / "projects" / "bottling"
COUNTER = """PROGRAM Main
VAR
    n : INT;
    x : LREAL := 0.5;
    t : TIME := T#1s500ms;
END_VAR
n := n + 1;
END_PROGRAM
"""


def tappet(*arguments: object) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "tappet", *(str(argument) for argument in arguments)]
    return subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)


def written(path: Path, text: str) -> Path:
    path.write_text(text, encoding="utf-8")
    return path


def test_run_prints_iec_literals_after_the_last_cycle(tmp_path: Path) -> None:
    file = written(tmp_path / "counter.st", COUNTER)
    done = tappet("run", file, "--virtual", "--cycles", 7, "--print", "Main.n", "--print", "Main.t")
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines() == ["Main.n = 7", "Main.t = T#1s500ms"]


def test_run_takes_start_values_and_shows_statistics(tmp_path: Path) -> None:
    file = written(tmp_path / "counter.st", COUNTER)
    done = tappet(
        "run", file, "--virtual", "--time", "1s", "--set", "Main.n=100", "--print", "Main.n", "--stats"
    )
    assert done.stdout.splitlines()[0] == "Main.n = 200"
    assert "task Task: cycles 100, mean " in done.stdout


def test_run_writes_a_trace_with_a_row_for_each_cycle(tmp_path: Path) -> None:
    file = written(tmp_path / "counter.st", COUNTER)
    trace = tmp_path / "trace.csv"
    assert (
        tappet("run", file, "--virtual", "--cycles", 5, "--print", "Main.n", "--trace", trace).returncode == 0
    )
    rows = list(csv.DictReader(trace.open(encoding="utf-8")))
    assert [row["Main.n"] for row in rows] == ["1", "2", "3", "4", "5"]


def test_run_in_real_time(tmp_path: Path) -> None:
    file = written(tmp_path / "counter.st", COUNTER)
    done = tappet("run", file, "--cycles", 3, "--print", "Main.n", "--format", "json")
    assert int(json.loads(done.stdout)["values"]["Main.n"]) >= 3


def test_an_exception_of_the_program_is_named_with_its_place(tmp_path: Path) -> None:
    text = COUNTER.replace("n := n + 1;", "n := 10 / (n - n);")
    done = tappet("run", written(tmp_path / "fault.st", text), "--virtual")
    assert done.returncode == 1
    assert "Main" in done.stderr
    assert "line 7" in done.stderr


def test_run_reports_an_initialiser_that_fails(tmp_path: Path) -> None:
    text = (
        "FUNCTION Part : INT\nVAR_INPUT n : INT; END_VAR\nPart := 10 / n;\nEND_FUNCTION\n"
        "PROGRAM Main\nVAR zero : INT; x : INT := Part(zero); END_VAR\nEND_PROGRAM\n"
    )
    done = tappet("run", written(tmp_path / "initial.st", text), "--virtual")
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr.splitlines()[-1] == "tappet: task initialisation: division by zero in Part, line 3"


def test_an_endless_loop_ends_with_an_exception(tmp_path: Path) -> None:
    text = COUNTER.replace("n := n + 1;", "WHILE n < 10 DO\n    n := n AND 1;\nEND_WHILE")
    done = tappet("run", written(tmp_path / "loop.st", text), "--virtual", "--cycle-limit", 0.3)
    assert done.returncode == 1
    assert "tappet: task Task" in done.stderr


def test_check_names_file_line_column_severity_and_code(tmp_path: Path) -> None:
    file = written(tmp_path / "wrong.st", COUNTER.replace("n + 1", "m + 1"))
    done = tappet("check", file)
    assert done.returncode == 1
    found = [line for line in done.stdout.splitlines() if ": error " in line]
    assert len(found) == 1
    assert found[0].startswith(f"{file}:7:6: error E0201: ")
    assert "'m'" in found[0]
    machine = json.loads(tappet("check", file, "--format", "json").stdout)
    assert machine["ok"] is False
    assert [d["line"] for d in machine["diagnostics"] if d["severity"] == "error"] == [7]


def test_check_of_the_example_project_finds_nothing() -> None:
    done = tappet("check", BOTTLING)
    assert (done.returncode, done.stdout.strip()) == (0, "0 error(s), 0 warning(s)")


def test_wrong_usage_ends_with_two_and_says_what_would_be_right(tmp_path: Path) -> None:
    assert tappet("check", tmp_path / "nowhere").returncode == 2
    file = written(tmp_path / "counter.st", COUNTER)
    done = tappet("run", file, "--virtual", "--print", "Main.m")
    assert done.returncode == 2
    assert "'Main' (Main) has no member 'm'" in done.stderr
    assert tappet("run", file, "--cycles", 1, "--time", "1s").returncode == 2
    assert tappet("run", file, "--time", "soon").returncode == 2
    assert tappet("library", "show", "TONN").returncode == 2
    assert tappet("frobnicate").returncode == 2


def test_export_and_import_give_the_same_files(tmp_path: Path) -> None:
    archive, copy = tmp_path / "line.zip", tmp_path / "copy"
    assert tappet("export", BOTTLING, "--to", archive).returncode == 0
    assert tappet("import", archive, "--to", copy).returncode == 0
    original = {p.relative_to(BOTTLING): p.read_bytes() for p in BOTTLING.rglob("*") if p.is_file()}
    copied = {p.relative_to(copy): p.read_bytes() for p in copy.rglob("*") if p.is_file()}
    assert copied == original
    again = tappet("import", archive, "--to", copy)
    assert again.returncode == 0
    assert "exists already in this place" in again.stdout, "parts of a project come in beside what is there"


def test_library_show_gives_the_shape_of_the_catalogs() -> None:
    shown = json.loads(tappet("library", "show", "TON", "--format", "json").stdout)
    assert [(pin["name"], pin["type"]) for pin in shown[0]["inputs"]] == [("IN", "BOOL"), ("PT", "TIME")]
    listed = json.loads(tappet("library", "list", "--format", "json").stdout)
    assert "Standard" in {library["name"] for library in listed}


def test_build_writes_the_boot_application(tmp_path: Path) -> None:
    from tappet.codegen.package import CodePackage

    file = written(tmp_path / "counter.st", COUNTER)
    boot = tmp_path / "boot.tappet"
    done = tappet("build", file, "--boot", boot)
    assert done.returncode == 0, done.stderr
    assert "bytes of code" in done.stdout
    again = tappet("build", file, "--rebuild", "--format", "json")
    report = json.loads(again.stdout)
    assert report["ok"]
    assert report["code_id"] == CodePackage.from_bytes(boot.read_bytes()).code_id
    assert report["code_size"] > 0
    broken = written(tmp_path / "broken.st", COUNTER.replace("n + 1", "nowhere"))
    refused = tappet("build", broken, "--boot", tmp_path / "none")
    assert refused.returncode == 1
    assert "nowhere" in refused.stderr
    assert not (tmp_path / "none").exists()
