"""Trying out plans before anybody acts: which of them, or of their parts, the knowledge base lets nobody do.

In: a domain. Out: findings (`plans`): by `listed` of plans that are listed, by `grown` of those that are not.
"""
