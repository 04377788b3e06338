"""What the commands share: options, the terminal with its colours, JSON lines, optional libraries.

In: printed lines with roles. Out: the same text on the terminal; only this room knows of colours.
"""
