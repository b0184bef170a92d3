"""Reading, writing and forcing values."""
