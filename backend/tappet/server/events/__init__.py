"""The events socket of a project: changed objects and who is present."""
