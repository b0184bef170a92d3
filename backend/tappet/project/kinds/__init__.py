"""The kinds of project objects, one a file, each with one `ObjectKind`: all that is to be said of the kind.

`kind_registry` lists this folder; a new file here is a new kind. May import the rest of `project` that stands
below `object_kind`, and no other kind except for its name. `docs/extending.md` describes how to add one.
"""
