"""Rendering of report contents as one HTML file that prints well."""
