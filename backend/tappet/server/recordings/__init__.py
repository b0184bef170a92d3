"""Recordings of the flight recorder: kept in a project, opened in place of a runtime, replayed."""
