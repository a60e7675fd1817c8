"""Audits of many rides: driven or recorded, asked about, and searched for what deserves a look."""
