"""The path of a CNC program in 3D: a process a view decodes, draws by viser and answers the editor.

Start with `routes`; `service` starts the processes, `worker` runs in them and `picture` draws.
"""
