"""Recipes of projects: read from and written to controllers, compared with them, and their files."""
