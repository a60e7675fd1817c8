"""Why the ego drove so: who or what slowed it, held it or let it go."""
