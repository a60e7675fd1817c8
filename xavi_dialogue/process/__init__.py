"""Modules shared by all processes: settings, logging, child processes, exit statuses."""
