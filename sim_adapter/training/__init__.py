"""Samples to learn movements from: scripted trials, watched as the robot would.

In: a scene and scripts. Out: labelled movement samples.
"""
