"""`xavi serve`: the dialogue service as a process, which hosts the hub."""

import gc
import sys
from collections.abc import Callable
from functools import partial

from xavi_dialogue.bus.link import Link
from xavi_dialogue.bus.zenoh_bus import host
from xavi_dialogue.dialogue.manager import advance
from xavi_dialogue.dialogue.pipeline import Pipeline
from xavi_dialogue.dialogue.state.events import Asked
from xavi_dialogue.dialogue.state.state import Dialogue
from xavi_dialogue.nlg.surface.realiser import grammar
from xavi_dialogue.process import child_commands
from xavi_dialogue.runtime import system
from xavi_dialogue.service.in_process import make_pipeline
from xavi_dialogue.service.server import Service
from xavi_dialogue.storage.turn_log import TurnLog


def serve(link: Link, memory: TurnLog, note: Callable[[str], None], *, controlled: bool) -> None:
    """Serve until asked to stop.

    Args:
        link: of the hub.
        memory: stores turns.
        note: is called with messages for the operator.
        controlled: whether orders come on standard input.

    Raises:
        EndpointTaken: an endpoint is in use.
        BadLink: the link's configuration cannot be used.
    """
    orders: child_commands.Orders = system.new_queue()
    child_commands.quit_on_signals(orders)
    if controlled:
        child_commands.listen(sys.stdin, orders)
    pipeline = make_pipeline()
    _warm(pipeline)
    with host(link) as bus:
        service = Service(bus, pipeline, memory)
        service.open()
        note(f"serving at {' and '.join(bus.places) or 'no endpoint'}")
        service.run(partial(_told_to_quit, orders))
    memory.close()


def _told_to_quit(orders: child_commands.Orders) -> bool:
    """Check whether an order to quit has come; once true, it stays true."""
    while not orders.empty():
        if isinstance(orders.get(), child_commands.Quit):
            orders.put(child_commands.Quit())
            return True
    return False


def _warm(pipeline: Pipeline) -> None:
    """Load the grammars of parser and wording, so that the first passenger need not wait.

    The objects loaded here are permanent, so the garbage collector is told to skip them.
    """
    grammar()
    advance(pipeline, Dialogue(), Asked("warm", "warm", "Hello!", 0.0))
    gc.collect()
    gc.freeze()
