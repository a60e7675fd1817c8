"""Query and recorded traces in; Explanation, NoExplanation or NeedRollout out."""
