"""The debugger: breakpoints, halting, steps and call stacks of the loaded application.

`variant` links the instrumented code beside the normal one; `breakpoints` become a table that tasks read;
`frames` reads stacks of halted tasks; `debugger` is what operations use. What happens inside a cycle is in
executive/debug.st. Start at `debugger`.
"""
