"""Commands for those who write domains: find mistakes, learn movements.

In: a domain's files. Out: findings, evaluations, written clauses.
"""
