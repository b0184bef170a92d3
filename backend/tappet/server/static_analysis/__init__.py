"""Coding rules, and their check without a build."""
