"""Help: the reference of the language, the messages of the compiler, the views of the workbench."""
