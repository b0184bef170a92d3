"""Code generation: core modules become LLVM text, ELF objects and a `CodePackage` with its symbol map.

May import core, lang and libraries; knows nothing of the runtime.
Start with `build` (the driver), then `generate`, `package` (what the runtime receives), `emit_module` (LLVM
text) and `layout` (places of data).
"""
