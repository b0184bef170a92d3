"""Paths of CNC programs as they are drawn: objects of SM3_CNC to pieces of lines, in levels of detail.

Imports numpy alone. Start with `geo_info`, the objects as an array, then `polyline`, `curve` and `levels`.
"""
