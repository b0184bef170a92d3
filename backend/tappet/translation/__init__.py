"""Sentences of the product in the languages of its users: English is what is stored, logged and compared.

`language` knows the languages, `templates` finds the template that a sentence was made of, `sentences` has
the tables `zh/*.csv`. Imports no other room; `lang` (messages of the compiler) and `server` (all that it
answers) use it.
"""
