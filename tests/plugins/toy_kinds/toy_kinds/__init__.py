"""Two kinds of project objects as a plug-in: the examples of docs/extending.md."""
