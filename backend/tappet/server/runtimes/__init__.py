"""Soft PLCs: connections (`links`), the local one, control and state."""
