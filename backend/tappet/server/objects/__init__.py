"""Objects of the project tree."""
