"""`tappet bench`: the product's own benchmarks, each beside its baseline in the same run.

A benchmark prints both numbers and their ratio; nothing here asserts a time. May import every room but
the CLI. Start with `scan`; `jitter`, `build` and `editor` follow the same shape.
"""
