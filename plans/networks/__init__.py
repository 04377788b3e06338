"""The plan library as the grammar it is: productions compiled one by one, and tables of what tasks begin with and need.

In: productions. Out: a `Grammar` and its `Tables`, in time linear in the text: nothing is unrolled.
"""
