"""A grammar as items of states: terms and items as data, compiled methods, left corners, distances to what is observed.

In: a grammar and its tables (`plans.networks`). Out: methods, and what they say of items.
"""
