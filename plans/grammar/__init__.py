"""Productions to plans: what may stand in a body, parameters, alternatives, recursion to a bound.

In: ``goal --> task, action, …``. Out: every way to pursue a goal, as a `Plan`; a `PlanError` with file and line.
"""
