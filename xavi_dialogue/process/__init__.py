"""What processes share: settings, logging, child processes, exit statuses."""
