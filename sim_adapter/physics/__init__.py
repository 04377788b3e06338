"""The MuJoCo model of room, objects, human and robot, and its running: contacts, grips, positions.

In: a scene. Out: a model that is stepped, and where everything is.
"""
