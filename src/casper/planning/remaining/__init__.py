"""What is left to do where no plan of the library goes on: a planner finds it (docs/planning.md, "What is left").

In: a reading and a problem. Out: the robot's part in what a planner of Unified Planning found.
"""
