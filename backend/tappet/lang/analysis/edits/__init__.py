"""A second analysis after an edit: what is invalidated is analysed again, everything else is kept.

`body_edits` takes edits of bodies, `declaration_edits` those of declarations: `dependents` finds the texts
that are declared again, `relayout` those that only need a new size, `invalidated_bodies` the bodies that are
analysed again. What qualifies for neither is analysed as a whole.
"""
