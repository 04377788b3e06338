"""Clauses as the machine runs them, and terms as they are while it does.

In: clauses. Out: closures that match heads and build arguments, and the cells and the trail that they write.
"""
