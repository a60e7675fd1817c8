"""Reasons for how the ego drove: who or what slowed it, held it or let it go."""
