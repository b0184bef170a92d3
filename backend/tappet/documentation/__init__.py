"""The documentation of a project: what is printed, as HTML and PDF.

Imports `project` and `iec`; nothing of the compiler. Start with `compose.compose`, which makes a `Document`
of a project; `html` and `pdf` write it.
"""
