"""Kernels on numpy, for large libraries of chains by names, one goal or two at once; numpy is loaded with the first.

In and out: as `kernels`. Shapes, types and exactness stand in each file's head.
"""
