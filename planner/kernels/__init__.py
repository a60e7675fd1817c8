"""Computations that go step by step, compiled by numba.

Kernels call only those of their own file and of `stretches`: numba's cache does not notice changes
in files that a kernel imports.
`tests/planner/reference.py` computes the same in plain Python, except for the module `reaction`.

M is the number of other vehicles, T of steps of 0.2 s, N of path points, S of samples driven.
States [M, T, 4] hold x, y [m] of the front bumper, heading [rad] and speed [m/s]; x is NaN where
a vehicle is out of the network. Sizes [M, 2] hold length and width [m].
"""
