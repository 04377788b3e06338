"""The robot's eye: what it sees of the room, from where, and with how much noise.

In: the physics. Out: world states of what is in sight, and pictures.
"""
