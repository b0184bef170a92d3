"""What the editors draw and compute about motion, by the compiled libraries that will move the axes.

Imports `project`, `libraries`, `codegen` and `runtime`; the server runs it in a process of its own.
Start with `cam_program`, which runs the curves of SM3_Basic, and `cam_curves`, which asks it; with
`loop_tuning` for gains of position loops by a measurement.
"""
