"""Studies that the paper has not: many trials, poor sensors, partners who behave like people, one knob.

In: what is asked, and a function that runs trials. Out: `Data`.
"""
