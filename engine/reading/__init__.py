"""A reading: what observations say about the goal, by which policy, what is likely to come, what to ask.

In: observations. Out: posterior, outcome, explanations, frontier, questions.
"""
