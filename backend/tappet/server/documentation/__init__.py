"""The documentation of a project, to be printed."""
