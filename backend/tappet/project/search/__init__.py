"""Search and replace in a project: what is asked, what of an object is searched, what is found and replaced.

May import the project room and `iec`. Start reading at `query`, then `finding` and `replacing`.
"""
