"""An explanation: a plan with the leaves that were observed, where it stands, how it is drawn; Algorithm 1, word for word.

In: a plan, marks, a binding. Out: statuses, frontier, marked tree, picture.
"""
