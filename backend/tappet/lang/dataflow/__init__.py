"""Data-flow analyses of checked bodies: what rules need to know of values and assignments.

Imports only `lang`, no rule. `flow` follows assignments to reads, `intervals` bounds integer expressions,
`for_loops` gives the iterations of FOR loops with constant bounds.
"""
