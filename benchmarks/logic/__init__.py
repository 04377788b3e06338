"""The knowledge base and its peers (plain kanren, clingo, SWI-Prolog, rdflib) in one run, with equal answers."""
