"""Figures, drawn from an experiment's data alone: the same file gives the same picture.

In: `Data`. Out: a matplotlib figure.
"""
