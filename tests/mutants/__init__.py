"""One-line faults planted in the code of the rooms, and whether a test notices (docs/mutants.md).

python -m tests.mutants --seed 0 --count 320
"""
