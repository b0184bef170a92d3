"""Versions of an application in a runtime: who brought which when, and back to an earlier one."""
