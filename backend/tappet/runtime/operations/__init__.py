"""The wire operations of the soft PLC, each declared once: arguments, limits, reply, handler, REST route.

`declaration` defines operations, `registry` finds them: every module of this folder, and entry points of the
group `tappet.operations`. Service, client, REST and the shapes of the front end are derived from them,
nothing else lists operations. May import the runtime, not the server.
"""
