"""The library repository and library managers."""
