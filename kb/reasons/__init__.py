"""Why, why not, what would mend it, and whether a statement is valid.

In: a statement and what proves its conditions. Out: proofs, refusals, repairs and verdicts, in words and as data.
"""
