"""CNC programs: G-code text (DIN 66025) to lines and words, checks, and the words of an SMC_CNC_REF.

Imports no other room. Start reading in `words` (the model), then `parser`, `checks` and `word_list`.
"""
