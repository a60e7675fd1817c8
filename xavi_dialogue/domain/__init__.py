"""Domain: the typed values of questions and answers. No text, no record, no I/O.

This package is all that the parser and the realiser share. All values are frozen msgspec structs,
so that a turn can be stored and sent; the tag `is` tells the members of a union apart.
"""
