"""Ontologies of the web (OWL 2 RL and SWRL) as texts of the language, and back.

In: files in RDF/XML, Turtle, N-Triples, OWL/XML or functional syntax. Out: a folder of text, and findings that list
whatever no rule can say. `reading` makes axioms of files, `meaning` clauses of axioms; `importing` is the whole way.
"""
