"""What is seen: world states, tracking what is out of sight, qualitative relations, the partner's focus.

In: world states. Out: `Relations` and `Focus`, a step at a time.
"""
