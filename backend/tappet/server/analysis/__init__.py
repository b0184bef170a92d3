"""The analysis service: one worker process per open project, asked by the language server of all browsers.

`messages` is the seam. On the web server's side start reading at `service`, then `project` (a project and
its process), `client` (a browser socket) and `outbox`; these import nothing of `lang`. On the other side of
the seam is `worker`, the process, on top of `server.lsp`.
"""
