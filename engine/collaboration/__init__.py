"""The robot's part: which run of the frontier it takes, what it waits for, when its turn has come.

In: where a plan stands, and who can do what. Out: a `CollaborativePlan`; events of prediction and plan.
"""
