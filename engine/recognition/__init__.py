"""Counting explanations: kernels that count, one teller that says what the counts mean.

In: plans and observations. Out: counts, posteriors, standings, explanations best first (`docs/recognition.md`).
"""
