"""What a domain says of its partners: who they are, how they are read, for one goal or a day, and what each can do.

In: a knowledge base and a plan library. Out: agents, fresh readings and days.
"""
