"""The wire between the dashboard's process and the browsers that look at it."""

MISSING = "the dashboard needs more packages: pip install 'xavi-dialogue[dashboard]'"
