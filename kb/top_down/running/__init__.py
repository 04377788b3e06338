"""The machine that runs compiled clauses: choice points, strands that take turns, tables, negation.

In: linked predicates and a question. Out: answers, each with whether it is certain.
"""
