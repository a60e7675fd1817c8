"""Dialogue: the conversation as a function of its inputs. No sockets, clock or threads."""
