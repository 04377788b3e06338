"""Where lines come from: standard input, a file, a socket.

In: a name. Out: lines of bounded length, with their numbers, and a sentence where they end too soon.
"""
