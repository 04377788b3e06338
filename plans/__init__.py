"""The plan library: grammar clauses as goals, tasks and actions (`library` holds them, `relations` tells them).

In: productions. Out: plans as trees, and relations such as ``uses(Goal, Thing)``.
Rooms: trees (plans as data), grammar (how productions become plans), checks.
"""
