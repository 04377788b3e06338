"""Axioms and SWRL rules to clauses, each of which cites the axiom it comes from.

In: an `Ontology`. Out: clauses of plain Datalog, and for everything that no clause can say the reason.
"""
