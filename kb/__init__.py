"""The logic: a Prolog-style knowledge base whose predicates are kanren goals.

In: facts, rules and constraints, as text or from Python. Out: answers, proofs, reasons, repairs (`base` has them all).
Rooms, from the ground up: terms, text, relations, program, top_down, bottom_up, goals, reasons, store, checks,
ontologies.
"""
