"""The simulated robot: base, arm, hand and head.

In: actions of a collaborative plan. Out: a robot that drives, grasps, carries, places and washes.
"""
