"""The small typed IR every language is lowered to once, with the passes that work on it.

May import lang; knows nothing of LLVM. Start with `ir` (the nodes), then `lower` (tree to core), then
`ranges` (which checks can never fire) and `loops` (variables that live in registers).
"""
