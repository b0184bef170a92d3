"""The manual of the motion library: pages made from its sources, with charts of examples that were run.

`python -m tappet.manual` writes `docs/motion`. May import every room but the CLI. Start with `pages`;
`examples` and `recording` run the examples, `chart` draws them; `compliance` is PLCopen's statement.
"""
