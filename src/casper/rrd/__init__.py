"""A run as a recording for Rerun's viewer: the room in three dimensions and what the mind makes of it over time.

In: the events of a run and the world states beside them, as they come. Out: an .rrd file, written as the run goes on.
"""
