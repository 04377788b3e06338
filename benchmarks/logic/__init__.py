"""The knowledge base against its peers: plain kanren, clingo and SWI-Prolog, in one run, with equal answers."""
