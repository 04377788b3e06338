"""A run as one page to look at: recorded while it happens, printed when it is over.

In: the events of a run and the world states beside them. Out: a `Recording` (frozen data), and of it one HTML page that
needs nothing else: no network, no other file.
"""
