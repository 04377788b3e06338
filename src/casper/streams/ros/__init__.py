"""Recordings of ROS 2 in MCAP, without ROS: frames and detections become world states.

In: ``.mcap`` files, and the names that things have in a domain. Out: world states as lines of JSON, and findings.
"""
