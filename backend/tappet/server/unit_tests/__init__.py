"""Unit tests of an application, on virtual time."""
