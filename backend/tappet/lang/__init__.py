"""The IEC 61131-3 front end: text to checked syntax tree.

Imports nothing of the other rooms. Start reading at `parser.parse`, then `analysis.analyse`;
`ast` and `types` are the data that flow between them, `diagnostics` is the one table of messages.
"""
