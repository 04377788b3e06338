"""Counting explanations: kernels that count (`kernels`, `arrays`), one teller that says what the counts mean.

In: plans and observations. Out: counts, posteriors, standings, explanations best first (`docs/recognition.md`).
"""
