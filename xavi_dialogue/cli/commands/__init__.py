"""The commands of `xavi`, by topic; each imports what it needs when it runs."""
