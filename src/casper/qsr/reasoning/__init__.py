"""The algebra of the calculi: converses, compositions, conceptual neighbours, and what can hold at once.

In: names of base relations. Out: sets of them; closed networks, scenarios, or the three things that clash. Plain
Python; tables are worked out from their definitions when they are first asked for.
"""
