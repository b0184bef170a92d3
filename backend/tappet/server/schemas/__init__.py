"""Every JSON shape of the API, one module per resource; the TypeScript client is generated from them.

Request bodies refuse unknown fields, so that a misspelt one is an error and not silently ignored.
"""
