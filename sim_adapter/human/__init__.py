"""The simulated partner: walks, reaches, grasps, carries and puts down.

In: steps of a script. Out: a body that moves, step by step.
"""
