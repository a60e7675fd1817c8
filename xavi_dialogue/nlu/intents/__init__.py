"""Intents: what a text as a whole asks, learnt from annotated questions.

The grammar reads words and clauses; it is exact, and misses what is put in a new way. A classifier
over words and the grammar's own reading tells what such a text is likely to ask. Each intent has a
plain question, which the grammar reads; it stands beside the other readings, and grounding chooses.
"""
