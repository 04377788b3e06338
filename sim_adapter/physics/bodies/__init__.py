"""The robot's bodies: what one is, and those there are.

In: a scene. Out: the body in MuJoCo's model, and how its arm reaches. The rest of the robot is the same for all.
"""
