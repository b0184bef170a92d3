"""LLVM text to optimised ELF objects."""

from __future__ import annotations

import threading

import llvmlite.binding as llvm

from tappet.codegen.compile_options import FLAGS, LlvmError, OptimiseOptions

_lock = threading.Lock()
_ready = False


def initialise() -> None:
    """Start LLVM once per process."""
    global _ready  # process-wide state of the LLVM library
    with _lock:
        if _ready:
            return
        llvm.initialize_native_target()
        llvm.initialize_native_asmprinter()
        for flag in FLAGS:
            llvm.set_option("tappet", flag)
        _ready = True


def target_machine(options: OptimiseOptions) -> llvm.TargetMachine:
    """Target machine for position independent code."""
    initialise()
    target = llvm.Target.from_triple(options.triple)
    return target.create_target_machine(
        cpu=options.cpu, opt=min(options.level, 2), reloc="pic", codemodel="small"
    )


def compile_text(text: str, options: OptimiseOptions) -> bytes:
    """ELF object of an LLVM module given as text."""
    machine = target_machine(options)
    module = _optimised(text, options, machine)
    return bytes(machine.emit_object(module))


def _optimised(text: str, options: OptimiseOptions, machine: llvm.TargetMachine) -> llvm.ModuleRef:
    try:
        module = llvm.parse_assembly(text, llvm.create_context())
    except RuntimeError as error:
        raise LlvmError(str(error), text) from error
    tuning = llvm.create_pipeline_tuning_options(speed_level=options.level)
    tuning.loop_vectorization = options.level >= 2
    tuning.slp_vectorization = options.level >= 2
    builder = llvm.create_pass_builder(machine, tuning)
    manager = builder.getModulePassManager()
    manager.run(module, builder)
    _free(manager)
    return module


def _free(manager: llvm.ModulePassManager) -> None:
    """Give a pass manager back: llvmlite 0.50 overrides its own disposal, and 50 KiB a build would stay."""
    if type(manager).__dict__.get("_dispose") is None:
        llvm.newpassmanagers.NewPassManager._dispose(manager)
        manager.detach()
