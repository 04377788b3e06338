"""MuJoCo: a room with a partner and a robot in it, seen through the robot's eye (`trial` runs a whole one).

In: a domain's scene and a goal. Out: world states, and what the robot really does.
Rooms: room (geometry), physics (the model), human, robot, eye, training.
"""
