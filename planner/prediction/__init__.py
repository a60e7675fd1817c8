"""Prediction: goals of others, recognised by inverse planning."""
