"""The record of decisions: traces, events, and their parts."""
