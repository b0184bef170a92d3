"""Samples of ST for messages that no rule file explains: what is reported, and what is right.

Imports nothing. `*.txt` hold them: `=== CODE` begins what is reported, `--- accepted` what is right; lines
with `@` are described in `sample_texts`. A test runs all of them and the manual shows them.
"""
