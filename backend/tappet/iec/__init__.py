"""Facts of IEC 61131-3 that projects, compiler and server share: words and texts, languages, tasks, places.

The bottom of the tree: imports no other room. Texts are read by `tokens` with the patterns of `literals` and
`trivia`; `words` has the keywords, `sections` finds where declarations end. Begin with `tokens`.
"""
