"""What a row of clauses amounts to: which predicates there are, what each needs, strata, how each is answered.

In: clauses. Out: a `Program`, or a `ProgramError` with file and line.
"""
