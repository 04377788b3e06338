"""Plans that are grown lazily: what is open of a goal's instance is a network of tasks, grown as far as is observed.

In: a plan library as the grammar it is, and observations. Out: `Networks`, which goes on from state to state
(`engine.episodes.growing`); `derivations` is its executable specification, and draws trees.
"""
