"""What terms are worth: the values of expressions, the order of all terms, what is counted or summed over answers.

Ground terms come in; numbers, keys to sort by and results of aggregates go out, or `EvaluationFailed` with a sentence.
"""
