"""Answers from the question downwards, for what cannot be listed: resolution within a budget.

In: conditions. Out: substitutions, lazily; `BudgetExceeded` where the answer is unknown.
"""
