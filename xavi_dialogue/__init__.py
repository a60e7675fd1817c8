"""XAVI Dialogue: a car that answers its passengers from its own planner's record."""

import os

__version__ = "0.1.0"

# Matrices here are small: threads of the linear algebra only get in each other's way.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
