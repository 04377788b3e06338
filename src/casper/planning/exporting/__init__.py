"""Domains as problems of planners: the way back from ``importing`` (docs/planning.md, "Export").

In: a domain that says what its actions change. Out: a problem of Unified Planning, and whatever has no place in it.
"""
