"""Files to axioms: five syntaxes, one result, whatever stands in which order.

In: a file. Out: an `Ontology` of frozen axioms with their places, or a `ReadError` that says where the file goes wrong.
"""
