"""The folder format: a project as text files that diff well, and the same files in a zip archive.

Stands on `tappet.project` alone. Start reading at `codec`: a project to files by path and back; `disk` and
`archive` only move files. `docs/project-folder.md` describes the format.
"""

from tappet.project.folder.archive import read_zip, write_zip
from tappet.project.folder.codec import decode, encode
from tappet.project.folder.disk import load, save

__all__ = ["decode", "encode", "load", "read_zip", "save", "write_zip"]
