"""Large texts: plain sentences by expressions, runs of facts as rows, all else by the parser.

In: a text, and how any sentence is read. Out: the sentences the parser would give, and blocks of facts.
"""
