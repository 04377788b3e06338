"""The mind: perception, focus, movements, actions, verification, explanation, collaboration."""
