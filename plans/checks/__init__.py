"""What is wrong with a plan library: mistakes in productions, goals that cannot be told apart.

In: sentences and plans. Out: findings with file, line and severity.
"""
