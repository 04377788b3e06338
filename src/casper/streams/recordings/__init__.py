"""Recordings: what minds took in, as lines of JSON that are replayed bit for bit.

In: world states, reports, and what was told beside the minds. Out: a file, and the same events from it.
"""
