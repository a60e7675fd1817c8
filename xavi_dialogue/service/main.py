"""`xavi serve`: the dialogue service as a process, which hosts the hub."""

import gc
import sys
from collections.abc import Callable
from functools import partial

from xavi_dialogue.bus.link import Link
from xavi_dialogue.bus.shards import ALL, Shard
from xavi_dialogue.bus.zenoh_bus import host, join
from xavi_dialogue.dialogue.manager import advance
from xavi_dialogue.dialogue.pipeline import Pipeline
from xavi_dialogue.dialogue.state.events import Asked
from xavi_dialogue.dialogue.state.state import Dialogue
from xavi_dialogue.nlg.surface.realiser import grammar
from xavi_dialogue.process import child_commands
from xavi_dialogue.process.garbage import Sweeper
from xavi_dialogue.runtime import system
from xavi_dialogue.service.in_process import make_pipeline
from xavi_dialogue.service.membership import Place
from xavi_dialogue.service.server import Service
from xavi_dialogue.storage.turn_log import TurnLog

PATIENCE = 10.0  # [s] for a router to come up


def serve(
    link: Link,
    memory: TurnLog,
    note: Callable[[str], None],
    *,
    controlled: bool,
    shard: Shard = ALL,
) -> None:
    """Serve until asked to stop.

    Args:
        link: of the hub, or to a router.
        memory: stores turns.
        note: is called with messages for the operator.
        controlled: whether orders come on standard input.
        shard: of the cars that it answers about.

    Raises:
        HubUnreachable: there is no router to join.
        EndpointTaken: an endpoint is in use.
        BadLink: the link's configuration cannot be used.
    """
    orders: child_commands.Orders = system.new_queue()
    child_commands.quit_on_signals(orders)
    if controlled:
        child_commands.listen(sys.stdin, orders)
    pipeline = make_pipeline()
    _warm(pipeline)
    place = Place(shard, joins=bool(link.connect) or link.config is not None)
    with join(link, PATIENCE) if link.mode == "client" else host(link) as bus:
        service = Service(bus, pipeline, memory, place, note)
        service.rest = Sweeper().sweep
        service.open()
        note(f"serving {_where(bus.places, link)}{'' if shard.of == 1 else f', shard {shard}'}")
        service.run(partial(_told_to_quit, orders))
    memory.close()


def _where(places: tuple[str, ...], link: Link) -> str:
    if link.mode == "client":
        return f"through {' or '.join(link.connect) or 'a router'}"
    return f"at {' and '.join(places) or 'no endpoint'}"


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
