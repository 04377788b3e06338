"""Streams of world states: from files, sockets and recordings, put in order, watched, recorded and replayed.

In: lines of JSON. Out: what a mind takes in, in the order of time, and a sentence for whatever is left out.
"""
