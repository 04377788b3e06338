"""What is stated and what follows from it just now: the state behind a knowledge base.

In: clauses that are added and taken back. Out: a model with all relations, kept up as they change.
"""
