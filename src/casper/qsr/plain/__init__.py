"""Each relation of one pair at one step in plain Python: the executable specification, and the kernel for few pairs.

In: metres as floats. Out: labels. `casper.qsr.arrays` has the same on numpy, and tests hold the two equal bit for bit:
both take the same elementary operations in the same order (a square root of a sum of squares, never ``hypot``, which
rounds differently in C and in Python).
"""
