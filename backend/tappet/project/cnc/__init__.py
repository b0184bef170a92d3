"""CNC programs in the project: their data and those of the settings that all of an application share.

Imports the plain data of `project`; the kinds of the tree use it. What the texts mean is read elsewhere.
Start with `program`.
"""
