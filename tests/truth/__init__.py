"""Tests of the reader of answers, which checks them against what was seen and decided."""
