"""Traces of runtimes and stored recordings: REST, live mirrors, long-term recording."""
