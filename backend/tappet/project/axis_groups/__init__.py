"""Axis groups of a project: settings, the variables that they are, and what the bus task of the axes does.

May import `project.axes` and what stands below it. Start with `settings`.
"""
