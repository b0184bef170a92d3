"""Instruction List: rows are read into the tree that ST has, too (spec fbd_ld_il.md 4 and 5).

May import the parser parts of `lang` up to the statements. Begin with `reader.InstructionList`; `operators`
is the table of instructions, `recognise` distinguishes IL from ST, `network` holds the accumulator.
"""
