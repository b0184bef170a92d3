"""Recipes: values for variables of an application, kept under names.

`definition` has the data of both kinds of objects, `code` what the compiler is given, `recipe_file` the text
files that are exchanged with controllers and other systems. Imports `iec` and the project model only.
"""
