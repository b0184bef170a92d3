"""DWARF line tables: from a program counter back to POU and line.

Only what that needs is written: one compile unit, a subprogram per function with the qualified POU name as
linkage name, a location per statement.
"""

from __future__ import annotations

from tappet.codegen.emit_text import quoted
from tappet.core import ir


class Metadata:
    """Numbered metadata nodes of one module."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.count = 0

    def add(self, text: str) -> int:
        """Append a node; its number."""
        number = self.count
        self.count += 1
        self.lines.append(f"!{number} = {text}")
        return number

    def reserve(self) -> int:
        """A number whose node follows with `define`."""
        number = self.count
        self.count += 1
        return number

    def define(self, number: int, text: str) -> None:
        """Node of a reserved number."""
        self.lines.append(f"!{number} = {text}")


class DebugInfo:
    """Files, subprograms and locations of one module."""

    def __init__(self, metadata: Metadata, producer: str = "tappet") -> None:
        self.metadata = metadata
        self.files: dict[str, int] = {}
        main = metadata.add('!DIFile(filename: "application", directory: "")')
        self.unit = metadata.add(
            f'distinct !DICompileUnit(language: DW_LANG_C99, file: !{main}, producer: "{producer}", '
            "isOptimized: true, runtimeVersion: 0, emissionKind: LineTablesOnly, nameTableKind: None)"
        )
        self.signature = metadata.add("!DISubroutineType(types: !{null})")
        self.dwarf = metadata.add('!{i32 7, !"Dwarf Version", i32 4}')
        self.version = metadata.add('!{i32 2, !"Debug Info Version", i32 3}')

    def file(self, uri: str) -> int:
        """Node of a source text."""
        number = self.files.get(uri)
        if number is None:
            name = quoted(uri.encode())
            number = self.files[uri] = self.metadata.add(f'!DIFile(filename: "{name}", directory: "")')
        return number

    def subprogram(self, function: ir.Function) -> int:
        """Node of a function."""
        file = self.file(function.uri)
        # line tables carry no linkage names, so the name itself is the qualified one
        name = linkage = quoted(function.name.encode())
        line = max(function.line, 1)
        return self.metadata.add(
            f'distinct !DISubprogram(name: "{name}", linkageName: "{linkage}", '
            f"scope: !{file}, file: !{file}, "
            f"line: {line}, type: !{self.signature}, scopeLine: {line}, "
            f"spFlags: DISPFlagDefinition | DISPFlagOptimized, unit: !{self.unit})"
        )

    def location(self, subprogram: int, line: int) -> int:
        """Node of a line in a function."""
        return self.metadata.add(f"!DILocation(line: {max(line, 1)}, scope: !{subprogram})")

    def named(self) -> list[str]:
        """Named metadata lines that end the module."""
        return [
            f"!llvm.dbg.cu = !{{!{self.unit}}}",
            f"!llvm.module.flags = !{{!{self.dwarf}, !{self.version}}}",
        ]
