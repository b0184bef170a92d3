"""Language services for editors: completion, hover, definition, references, rename, outline, formatting.

Pure functions over a `workspace.Snapshot`, a document and a position; they import only `lang`. Start at
`documents` (which lines of which text a document shows) and `workspace`; `results` is what they return.
"""
