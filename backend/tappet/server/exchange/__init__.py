"""Import and export of files of other systems."""
