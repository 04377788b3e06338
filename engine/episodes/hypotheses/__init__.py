"""What is believed of a day: hypotheses, where an observation leads from them, what is dropped, closed and agreed on.

In: observations, and how plans go on (`engine.episodes.growing`). Out: the next level of hypotheses.
"""
