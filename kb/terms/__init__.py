"""The data of the language: terms, how they are written and unified, clauses, comparisons.

In: functors and arguments. Out: frozen terms and clauses, substitutions. Knows of no text and of no evaluation.
"""
