"""What lines hold, in the order of time: out of order, twice, by a clock that was set; names and places that cannot be.

In: lines. Out: world states and reports that a mind can take in one after the other, and a sentence for all else.
"""
