"""The code of a loaded application: the normal one, and the instrumented variant beside it."""

from __future__ import annotations

from collections.abc import Mapping

from tappet.codegen.package import INIT_SYMBOL, CodePackage
from tappet.runtime.axis_programs import brake_of
from tappet.runtime.contexts import Contexts
from tappet.runtime.debugger.variant import Variant
from tappet.runtime.described_types import SERVICE, DescribedTypes
from tappet.runtime.executive.loader import FILE_SERVICES, Executive
from tappet.runtime.files import ApplicationFiles
from tappet.runtime.heap import ApplicationHeap
from tappet.runtime.image import Image
from tappet.runtime.link import LinkedCode, LinkError
from tappet.runtime.task_group import TaskGroup


class ApplicationCode:
    """Links code against the image, and has tasks run it from their next cycle on."""

    executive: Executive
    package: CodePackage
    virtual: bool
    image: Image
    heap: ApplicationHeap
    contexts: Contexts
    tasks: TaskGroup
    files: ApplicationFiles
    code: LinkedCode
    variant: Variant | None
    """The instrumented variant, once a debugger needs it."""

    def link(self, package: CodePackage) -> LinkedCode:
        """Link a package against this image; LinkError names what is missing."""
        code = self.link_objects(package, package.objects, {})
        try:
            self.heap.serve(code)
        except OSError as error:
            code.close()
            raise LinkError(f"there is no memory for __NEW: {error}") from error
        return code

    def link_objects(
        self, package: CodePackage, objects: list[bytes], besides: Mapping[str, int]
    ) -> LinkedCode:
        """Link objects that are the code of a package; they may use the symbols in `besides`."""
        base = self.image.address
        imports = {**self.executive.services, **besides}
        imports |= {symbol: base + place.offset for symbol, place in package.data_objects.items()}
        wanted = {INIT_SYMBOL, *(t.symbol for t in package.tasks), *package.exports}
        return self.executive.linker.link(objects, sorted(wanted), imports)

    @property
    def codes(self) -> list[LinkedCode]:
        """The code that tasks may be in: the normal one, and the instrumented variant where there is one."""
        return [self.code] if self.variant is None else [self.code, self.variant.linked]

    @property
    def halted(self) -> bool:
        """Whether a task stands at a statement: what is written is stored at once."""
        return self.variant is not None and self.variant.any_halted

    def drop_variant(self) -> None:
        """The instrumented variant is no more that of the code; it goes once no task is in it."""
        if self.variant is not None:
            self.variant.detach()
            self.tasks.retire(self.variant, self.variant.close)
            self.variant = None

    def connect_code(self, code: LinkedCode) -> None:
        """From its next cycle on every task runs `code`."""
        self.code = code
        self.heap.new_code()
        self.heap.poison(self.package.facts.heap_poison)
        self.connect_files()
        self.connect_types()
        for spec, task in zip(self.package.tasks, self.contexts.tasks, strict=True):
            self.executive.store(task.place("pCode"), code[spec.symbol])
            brake = brake_of(self.package, spec.name)
            if brake is not None:
                self.executive.store(task.place("pStood"), self.image.address + brake.stood)
            self.executive.store(task.place("pBrake"), code[brake.symbol] if brake is not None else 0)

    def connect_files(self) -> None:
        """Open the folder of files and start the thread that serves requests, once code needs them."""
        if self.files.opened or self.code.imported.isdisjoint(FILE_SERVICES):
            return
        self.files.open()
        if not self.virtual:
            self.tasks.launch_files(self.files.wake)

    def connect_types(self) -> None:
        """Describe types and variables to code that asks for them."""
        if SERVICE not in self.code.imported:
            return
        described = DescribedTypes(self.executive, self.package.symbols, self.image.address)
        self.tasks.publish(self.contexts.application.place("pTypes"), described.address, described)
