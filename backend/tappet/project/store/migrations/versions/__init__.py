"""One file a schema change, named NNNN_what.py in order."""
