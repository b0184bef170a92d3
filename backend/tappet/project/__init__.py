"""The project: a tree of objects as plain data, its folder format and its database store.

Imports no other room; all others may read it. Start reading at `model` (what a project is), then
`edit` (what can be done to it), `sources` (what the compiler gets), `folder` and `store` (where it is kept).
"""
