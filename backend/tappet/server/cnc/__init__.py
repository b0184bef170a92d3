"""What the editors of CNC programs and their settings ask: CNC info, generated code, preprocessing blocks.

Start with `routes`. A program comes with the request as the editor has it; nothing here is stored.
"""
