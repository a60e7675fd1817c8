"""A server of the car's road network, which is needed to plan a recorded decision again."""

import gzip
import logging
from functools import partial
from pathlib import Path

from xavi_dialogue.bus.interface import Bus, Call, Keys
from xavi_dialogue.bus.messages import Failure, pack
from xavi_dialogue.storage.recording_format import MAX_PACKED, MIB

NETWORK = "@blob/network"

_LOG = logging.getLogger(__name__)


def serve_roads(bus: Bus, keys: Keys, network: Path) -> None:
    """Serve the network file of a car, gzipped, at `@blob/network`; refuse if it is too large.

    Raises:
        OSError: it cannot be read.
    """
    packed = gzip.compress(network.read_bytes(), mtime=0)
    if len(packed) > MAX_PACKED:
        _LOG.warning("roads too large to be told", extra={"vehicle": keys.vehicle})
        why = f"the roads have more than {MAX_PACKED // MIB} MiB"
        bus.serve(keys.of(NETWORK), partial(_refuse, why))
    else:
        bus.serve(keys.of(NETWORK), partial(_tell, packed))


def _tell(packed: bytes, call: Call) -> None:
    call.reply(packed)


def _refuse(why: str, call: Call) -> None:
    call.refuse(pack(Failure(reason="out-of-scope", detail=why)))
