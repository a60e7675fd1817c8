"""Domain: what is meant and what is answered, as typed values. No text, no record, no I/O.

Parser and realiser share this package alone. All values are frozen msgspec structs, so that a
turn can be stored and sent; a union is distinguished by the tag `is`.
"""
