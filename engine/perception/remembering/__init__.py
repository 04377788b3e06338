"""What was seen lately, in bounded memory, and how rules ask for it.

In: relations, step after step. Out: rows and episodes, with what is not known, as relations of a knowledge base.
"""
