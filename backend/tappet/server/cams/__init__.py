"""What the cam editor asks: curves and texts of a cam, computed in a process of its own.

Start with `routes`. A cam comes with the request as the editor has it; nothing here is stored.
"""
