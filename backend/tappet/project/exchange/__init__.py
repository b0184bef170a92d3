"""Projects of other systems in, and PLCopen XML out; every import ends in a report.

May import `tappet.project` only. Start reading at `importing` (which file goes to which importer), then
`drafts` and `placing`; `plcopen_write` is the exporter. `docs/import-export.md` says what is read.
"""
