"""Other processes: one domain served as JSON-RPC 2.0, one object a line (docs/server.md).

In: a stream of lines. Out: a stream of lines, one answer for every request, in order. Knows nothing of any one method's
logic: `methods` asks the domain, `protocol` speaks, `serving` waits, works and stops.
"""
