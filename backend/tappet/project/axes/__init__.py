"""Axes of an application: their settings, the variables they are, and what their bus task calls for them.

Imports the plain data of `project`; the kinds of the tree use it. Start with `settings`.
"""
