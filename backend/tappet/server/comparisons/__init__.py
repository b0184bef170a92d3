"""Comparing a project with another one, a revision, files or what runs; taking differences over."""
