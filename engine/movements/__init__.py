"""Which movement a step is: a look-up in the relation ``movement/5``, and how that relation is learned.

In: relations and focus. Out: a `Movement`; from samples a tree, and its clauses.
"""
