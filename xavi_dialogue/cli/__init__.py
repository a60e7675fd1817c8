"""The command line: commands, their errors, and checks of machine and bus."""
