"""The relations on numpy: all pairs and all steps at once, equal to `casper.qsr.plain` bit for bit.

In: a `Scene`, things by steps. Out: codes, relations by steps, small integers that number a calculus' labels.
"""
