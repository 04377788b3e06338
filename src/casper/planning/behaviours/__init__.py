"""Collaborative plans as behaviour trees of py_trees (docs/planning.md, "Behaviour trees").

In: the robot's part, and the code that does its actions. Out: a tree to tick; what is done is told to the reading.
"""
