"""The mind: what is seen, done, meant, and how to help (`mind` is the whole line, `events` what it says).

In: a domain, and world states or actions. Out: readings, explanations, collaborative plans, events.
Rooms, along the line: perception, movements, actions, verification, explanation, recognition, collaboration, reading,
domain; events are what all of them say.
"""
