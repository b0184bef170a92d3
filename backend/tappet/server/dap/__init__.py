"""The Debug Adapter Protocol: editors such as VS Code debug a soft PLC through it.

`messages` are the shapes on the wire, `session` carries requests out on a `debuggee`, `inspection` looks at a
halted one. Start reading in `session`.
"""
