"""Samples of traces: how they are kept, shown in windows, computed with and exchanged.

Imports the runtime (frames of its rings) and numpy; the server and the command line stand on it. Start
reading in `samples`, then `chunks` (recordings on disk) and `windows` (what a diagram gets).
"""
