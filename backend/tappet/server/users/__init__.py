"""Accounts for administrators, and the audit log."""
