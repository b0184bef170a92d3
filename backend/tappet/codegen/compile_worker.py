"""A process that compiles LLVM text for `compile_pool`: jobs on standard input, objects on standard output.

A job is the optimisation level, the processor and the triple as one JSON line, then the length of the text as
eight bytes and the text. The answer is a status byte (0 = object, 1 = error message), a length and the bytes.
"""

from __future__ import annotations

import json
import signal
import sys
from typing import BinaryIO

from tappet.codegen.compile_options import LlvmError, OptimiseOptions
from tappet.codegen.optimise import compile_text


def serve(source: BinaryIO, sink: BinaryIO) -> None:
    """Answer jobs until the input ends."""
    while line := source.readline():
        settings = json.loads(line)
        size = int.from_bytes(source.read(8), "little")
        text = source.read(size).decode()
        options = OptimiseOptions(settings["level"], settings["cpu"], settings["triple"])
        try:
            status, data = b"\0", compile_text(text, options)
        except LlvmError as error:
            status, data = b"\1", str(error).encode()
        sink.write(status + len(data).to_bytes(8, "little") + data)
        sink.flush()


if __name__ == "__main__":
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # ends quietly when the builder was killed
    serve(sys.stdin.buffer, sys.stdout.buffer)
