"""Unit tests written in ST: found, run on virtual time in a process of their own, reported.

Suites are blocks that extend FB_TestSuite of the library TappetUnit. May import what `runtime` may. Start
with `runner.run_tests`; `process` is what the command line and the server call.
"""
