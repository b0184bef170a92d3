"""The PLCopen coding rules and further optional static analysis (codes S1xxx), off unless switched on.

Imports only `lang`. One topic a module, as in `rules`; prefixes and limits are set in `lang.coding_settings`.
"""
