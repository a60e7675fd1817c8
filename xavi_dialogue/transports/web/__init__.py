"""The wire between the dashboard's process and the browsers that look at it."""
