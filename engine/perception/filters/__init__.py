"""What a poor sensor needs: its noise estimated on the way, Kalman filters for who walks and for what is handled.

In: world states as sensed. Out: steadier ones at an even pace, a little later (`steadying`).
"""
