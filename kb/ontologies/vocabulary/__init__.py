"""What an ontology is about, as names and terms of the language; what the language itself can say.

In: IRIs and data values. Out: readable names that lead back to their IRIs, terms, and of what kind each property is.
"""
