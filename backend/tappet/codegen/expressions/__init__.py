"""Expressions over the variables of a running application, such as the trigger of a trace or a condition.

`compiler` makes a short stack program of a text and the symbol map; `program` says what one is. The executive
evaluates it inside the cycle (runtime/executive/expressions.st), where nothing it meets can raise a fault.
"""
