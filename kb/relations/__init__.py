"""Rows of ground terms with their indexes: in Python, in numpy columns, and in layers over one another.

In: rows. Out: the rows that match a pattern, without touching any other.
"""
