"""The native executive: its ST sources, and what loads them into the process.

The `.st` files are the scan loop (start with `cycle.st`); `records` gives Python typed access to the
structures of `types.st`, `loader` links the object once per process and installs the signal handlers.
"""
