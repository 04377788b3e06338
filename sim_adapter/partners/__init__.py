"""Simulated partners: what they set out to do, what is out of the ordinary about it, and how they carry it out.

In: goals and behaviours. Out: a partner who goes about them, and the truth of what was done, to judge a trial by.
"""
