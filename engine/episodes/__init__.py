"""A whole day with a partner: goal after goal, several at once, given up, or with steps nobody modelled.

In: observations, each with its agent and time. Out: which goals are pursued now, the episodes that closed, and what was
needless. What a goal's plans are it learns from a `growing.Growing` alone; prices weigh what plans do not explain.
"""
