"""Problems of planners as domains: PDDL and HDDL, or Unified Planning's own (docs/planning.md, "Import").

In: a problem. Out: the text of a domain, and a finding for whatever it cannot say.
"""
