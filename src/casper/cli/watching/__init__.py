"""Commands that watch a partner: in the simulation, or through world states that somebody sends.

In: a domain, and a seed or world states. Out: events as a timeline, or as JSON lines.
"""
