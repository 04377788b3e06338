"""The engines: one interface to those that derive, SWI-Prolog in its own process and called from Python."""
