"""A whole plan out of a state: the leaves that are left of it, and the tasks between its goal and its leaves.

In: what was done, and what is open. Out: a smallest rest in order, and a derivation, as a part of a plan or drawn.
"""
