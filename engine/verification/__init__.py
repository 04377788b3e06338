"""What was done, whether it is valid, and which leaf of which plan it may be.

In: observations and statements. Out: verdicts, and bindings or mismatches with their reasons.
"""
