"""MuJoCo: the room, the human, the robot, and the adapter that emits world states."""
