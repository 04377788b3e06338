"""Every mistake of a text at once: names, bodies, facts, needs.

In: sentences, as far as they can be read. Out: findings with file, line and severity.
"""
