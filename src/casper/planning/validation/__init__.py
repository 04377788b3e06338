"""Plans of Unified Planning judged with reasons: which step, which condition, and what became of it.

In: a problem and a plan (in a row, partly ordered, timed, or of a hierarchy). Out: a `Judgement`. States are the
framework's own simulator's, so what holds is what holds there; the reasons are ours.
"""
