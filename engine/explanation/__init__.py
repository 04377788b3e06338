"""An explanation: a plan with the leaves that were observed, where it stands, how it is drawn; and Algorithm 1 itself.

In: a plan, marks, a binding. Out: statuses, frontier, marked tree, picture.
"""
