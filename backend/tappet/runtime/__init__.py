"""The soft PLC: loads a code package, runs its tasks natively and serves the online channel.

May import codegen, core, libraries and lang. Start with `plc` (life cycle), then `application` (one loaded
program), `executive` (the native loop, written in ST) and `service` (the wire); `local` is the same PLC
inside a process.
"""
