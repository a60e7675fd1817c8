"""Clock, waiting and threads, behind one door."""
