"""Behaviours: what people do besides following a plan. Each is a function from one conduct to another, and pure.

In: a conduct, where it takes place, random draws. Out: the conduct of somebody who behaves so.
"""
