"""What seems to have happened becomes an observation: put into context, judged, and weighed where that is not sure.

In: predictions of actions, and what they may be about. Out: observations for the reading, and events on the way.
"""
