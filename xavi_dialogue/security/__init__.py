"""Keys, certificates and tokens: who may do what."""
