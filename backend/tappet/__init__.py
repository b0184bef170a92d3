"""Tappet: engineering IDE and soft PLC for PLC and motion control."""

__version__ = "0.1.0"
