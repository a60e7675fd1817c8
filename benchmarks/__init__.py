"""Benchmarks: planning, driving, recognising, answering. See docs/bench.md."""
