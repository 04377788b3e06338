"""The plan library: grammars become goals, tasks, methods and steps, and networkx trees."""
