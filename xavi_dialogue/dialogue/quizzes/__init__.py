"""Questions of ours to the passenger, and their solutions."""
