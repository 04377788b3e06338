"""What counts: how explanations of many observations come from those of one less, without making any.

In: plans, a level, an observation. Out: the next level; sums, the best, and where explanations end (`kernel`).
"""
