"""The structures of the Language Server Protocol 3.17 that the server reads and writes, and no others.

Undeclared fields of clients are ignored; declared ones have their type, or decoding fails and names them.
Absent optional fields are left out, never null. Importing every structure of the protocol took half of the
time to the first message; a test holds these against the types generated from the specification.
"""
