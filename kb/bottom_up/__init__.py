"""Everything that follows, derived from the facts upwards: joins, fixpoints, upkeep after a change.

In: a program and its rows. Out: a relation for every stored predicate; `specification` is the plain version of it.
"""
