"""Which action the movements amount to: an ensemble of machines, read by an HMM or by similarity.

In: movements. Out: a `Prediction`, put into context.
"""
