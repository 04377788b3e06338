"""The knowledge base and its peers (plain kanren, clingo, SWI-Prolog) in one run, with equal answers."""
