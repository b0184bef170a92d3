"""Cams: their data, the laws of their segments, what is wrong with them, and the ST that is made of them.

Imports the plain data of `project`; the kind of the tree uses it. Start with `table`.
"""
