"""Why we, or other vehicles, did or did not do something."""
