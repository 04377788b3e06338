"""The calculi: frozen settings with their labels and two kernels, one on arrays and one in plain Python.

In: a scene, or one tuple of things at a step. Out: codes, or a label. The kernels give the same answers; that on arrays
is loaded (numpy with it) when it is first used.
"""
