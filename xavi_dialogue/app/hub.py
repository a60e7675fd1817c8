"""`xavi serve`: the dialogue service as a process, host of the hub."""

import queue
import sys

from xavi_dialogue.app import control
from xavi_dialogue.app.local import make_mind
from xavi_dialogue.app.memory import Memory
from xavi_dialogue.app.service import Service
from xavi_dialogue.transports.bus import Keys
from xavi_dialogue.transports.zenoh_bus import host


def serve(endpoint: str, memory: Memory, *, controlled: bool) -> None:
    """Serve until told to stop.

    Args:
        endpoint: of the hub.
        memory: keeps what is said.
        controlled: by orders on standard input.

    Raises:
        EndpointTaken: the endpoint is in use.
    """
    orders: control.Orders = queue.SimpleQueue()
    control.quit_on_signals(orders)
    if controlled:
        control.listen(sys.stdin, orders)
    mind = make_mind()
    with host(endpoint) as bus:
        service = Service(bus, Keys(), mind, memory)
        service.open()
        service.run(lambda: not orders.empty() and isinstance(orders.get(), control.Quit))
    memory.close()
