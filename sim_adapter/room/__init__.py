"""The room as plain geometry: the scene's facts, settings, places to put things, ways around furniture.

In: a domain's scene facts. Out: positions, poses and paths; knows of no MuJoCo.
"""
