"""The Language Server Protocol over `lang.services`: one session per editor connection.

Start reading at `session` (what is answered), then `rpc` (messages in order) and `convert` (shapes).
`project_programs` and `folder_programs` say what is compiled together; `stdio` serves other editors.
"""
