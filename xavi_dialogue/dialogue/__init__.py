"""Dialogue: the conversation as a pure function of its inputs. No sockets, clock or threads."""
