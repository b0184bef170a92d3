"""The PLCopen coding rules and further optional static analysis (codes S1xxx), off unless switched on.

Imports only `lang`. One rule per file, as in `rules`; prefixes and limits stand in `lang.coding_settings`.
"""
