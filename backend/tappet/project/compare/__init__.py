"""Two projects compared, and differences taken over from one into the other.

Stands on `tappet.project` alone. Start reading at `differences`; `taking` is the way back.
"""
