"""Brings the instrumented variant of an application into its runtime; what the debugger does is in there."""
