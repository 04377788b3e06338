"""Commands that ask a domain something: what holds, whether it is valid, what observations speak for, in conversation.

In: a domain and a question. Out: printed objects of the knowledge base and the mind, or JSON lines.
"""
