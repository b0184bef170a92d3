"""Projects of other systems in, and PLCopen XML out; every import ends in a report.

May import `tappet.project` only. Start reading at `importing` (which file goes to which importer), then
`drafts` and `placing`; `plcopen_write` is the exporter. `docs/import-export.md` says what is read.
"""

from tappet.project.exchange.choosing import ImportNode
from tappet.project.exchange.importing import (
    ARCHIVES,
    TAKEN,
    Imported,
    import_files,
    importable,
    is_importable,
)
from tappet.project.exchange.placing import Place
from tappet.project.exchange.report import ExchangeError, ImportReport

__all__ = [
    "ARCHIVES",
    "TAKEN",
    "ExchangeError",
    "ImportNode",
    "ImportReport",
    "Imported",
    "Place",
    "import_files",
    "importable",
    "is_importable",
]
