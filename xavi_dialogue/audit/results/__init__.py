"""What an audit found: tables, plots and a page."""
