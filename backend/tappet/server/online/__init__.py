"""The online channel: live values of a runtime to many browsers, at the pace of each.

Start reading at `channel` (one socket), then `layout` (expressions to places) and `sampler` (one recorder for
all who want the same values).
"""
