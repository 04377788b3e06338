"""Predicates as kanren goals, and kanren's own combinators done fair and flat.

In: a knowledge base and logic variables. Out: streams of kanren states.
"""
