"""The structures of the Language Server Protocol 3.17 that the server reads and writes, and no others.

Contract: names, fields and numbers are those of the specification, in Python's spelling (`text_document` is
`textDocument` on the wire). Of what clients send, fields that are not declared here are ignored; what is
declared has the type, or decoding fails and names the field. Of what is sent, optional fields that are absent
are left out, never null. `structures` has what the others consist of; `lifecycle`, `synchronization` and
`features` follow the chapters of the specification; `product` has the requests that are ours (`tappet/...`).

Reason: a language server reads them before it can say anything. Declaring what it uses takes 5 ms; importing
every structure of the protocol with a converter took 350 ms, half of the time to the first message. A test
holds them against the types that are generated from the specification.
"""
