"""Traces: where things were, step after step, from arrays, rows, data frames and files, with what is missing.

In: coordinates under names and times. Out: a `Trace`, whose numbers are finite and whose times grow.
"""
