"""Plans as trees of frozen data: nodes, what their shapes mean for the leaves, marked networkx trees.

In: goals, tasks, shapes and actions. Out: `Plan`, `Chart`, DiGraphs; `spelling` spells every order out.
"""
