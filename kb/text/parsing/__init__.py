"""Parsing: tokens, terms by the priorities of operators, the conditions of bodies, places of mistakes.

In: a text and a table of operators. Out: terms and conditions, sentence by sentence, or a `ReadError` with its line.
"""
