"""Declarations, types, names, constants and calls: from syntax trees to a checked, resolved program.

Imports only `lang`. Start reading at `result` (what analysis leaves for code generation) and `run`
(the order of the passes); `expressions`, `calls`, `statements` handle one node class per function.
"""
