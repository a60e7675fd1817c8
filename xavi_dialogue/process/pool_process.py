"""The beginning of a process in a pool of `concurrent.futures`."""

import multiprocessing
import os
import signal
import threading


def end_with_parent() -> None:
    """End this process when its parent ends, however that does, and not by Ctrl-C before."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()
    assert parent is not None

    def watch() -> None:
        parent.join()
        os._exit(1)

    threading.Thread(target=watch, name="parent", daemon=True).start()
