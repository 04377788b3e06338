"""What is neither true nor false: what rests on failed evaluations, negation that runs in a circle, recursive minima.

In: a stratum and the relations below it. Out: its rows, and beside them the undefined ones (`Relation.undefined`).
"""
