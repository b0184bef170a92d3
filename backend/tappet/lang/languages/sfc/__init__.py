"""Sequential Function Chart: textual charts, and what a chart becomes in the tree (spec language_sfc.md).

`reader` reads a `chart.Chart`, `translate` makes the variables and statements of it that carry out the model
of section 6; `IecSfc.st` holds the types of steps and actions. May import what `il` may.
"""
