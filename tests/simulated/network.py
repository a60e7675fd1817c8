"""The bus of the simulated world: late, lost, doubled and disordered messages, and partitions.

It does what docs/bus.md promises of Zenoh: everything goes through one hub; reports that are kept
are delivered in the end to whoever is linked, also to late joiners, but in any order and perhaps
twice; a request gets one outcome; a sign of life goes with its connection. What each node does is
checked against the table of roles.
"""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache
from itertools import count
from types import TracebackType
from typing import Any, Self

from tests.simulated.scheduler import Process, Scheduler
from xavi_dialogue.bus.access_control import ROLES
from xavi_dialogue.bus.interface import (
    FLEET,
    ROOT,
    BusFailed,
    CallHandler,
    Handler,
    NobodyThere,
    Outcome,
    Presence,
    Publisher,
    Refused,
    TooLate,
    Watcher,
)
from xavi_dialogue.bus.interface import matches as _matches

matches = cache(_matches)

NEAR = (0.0002, 0.003)  # [s] least and greatest delay of a message in fair weather
RECOVERED = (0.2, 0.6)  # [s] until a lost report that is kept is delivered after all
NOTICED = 0.7  # chance that a request ends with the hub, and not with its time
FAREWELL = (0.0, 0.05)  # [s] until the end of a connection is noticed


@dataclass
class Weather:
    """What happens to messages at present."""

    delay: float = 0.0  # [s] greatest further delay
    loss: float = 0.0  # chance that a message is lost
    twice: float = 0.0  # chance that it comes twice
    disorder: float = 0.0  # [s] greatest further delay that does not keep the order


@dataclass(eq=False)
class Served:
    """One request as it came in at a server, with what became of it."""

    key: str
    payload: bytes
    server: Process
    came: float  # [s]
    timeout: float  # [s] of who asked
    ends: list[tuple[float, str]] = field(default_factory=list)  # [s] and what the server did


@dataclass(eq=False)
class Asked:
    """One request as it was sent, with what came of it."""

    number: int
    key: str
    payload: bytes
    asker: Process
    sent: float  # [s]
    timeout: float  # [s]
    troubled: bool = False  # whether a link, a message or a process failed it
    outcomes: list[tuple[float, Outcome]] = field(default_factory=list)
    end: Callable[[Outcome], None] = lambda _: None


@dataclass(eq=False)
class Kept:
    """What a publisher keeps for late joiners."""

    key: str
    node: "Node"
    number: int  # of the publisher
    messages: deque[tuple[int, bytes]]
    sent: int = 0


@dataclass(eq=False)
class Subscription:
    key: str
    node: "Node"
    handler: Handler
    kept: bool
    had: set[tuple[int, int]] = field(default_factory=set)  # publisher and number of a message

    def withdraw(self) -> None:
        if self in self.node.subscriptions:
            self.node.subscriptions.remove(self)


class Network:
    """The hub, which lives in the process of the service, and everybody's links to it."""

    def __init__(self, scheduler: Scheduler) -> None:
        self.scheduler, self.dice = scheduler, scheduler.dice
        self.weather = Weather()
        self.nodes: list[Node] = []
        self.hub: Process | None = None
        self.apart: set[str] = set()  # machines that reach the hub no more
        self.served: list[Served] = []
        self.asked: list[Asked] = []
        self.forbidden: list[str] = []  # what nodes did against their roles
        self._kept: list[Kept] = []
        self._queues: dict[tuple[Node, Node, str], float] = {}  # [s] when the latest one arrives
        self._keepers = count()

    def connect(self, process: Process, role: str, *, hosts: bool = False) -> "Bus":
        """Return a process's connection."""
        node = Node(process, role)
        self.nodes.append(node)
        if hosts:
            self.hub = process
        process.ends.append(lambda: self._leave(node))
        self.changed()
        return Bus(self, node)

    def linked(self, node: "Node") -> bool:
        """Check whether a node reaches the hub."""
        hub = self.hub
        there = hub is not None and hub.alive and node.process.alive and not node.closed
        machine = node.process.machine
        return there and (hub.machine == machine or not {machine, hub.machine} & self.apart)

    def changed(self) -> None:
        """Tell everybody soon who has come and gone, and recover what was missed."""
        for node in self.nodes:
            delay = self.dice.uniform(*FAREWELL)
            self.scheduler.after(delay, lambda node=node: self._update(node), node.process)

    def cut(self, machine: str, *, apart: bool) -> None:
        """Separate a machine from the hub, or let it back."""
        (self.apart.add if apart else self.apart.discard)(machine)
        if apart:
            self._trouble(machine)
        self.changed()

    def _trouble(self, machine: str) -> None:
        """Note that the requests under way from or to a machine may fail."""
        hub = self.hub
        for asked in self.asked:
            if not asked.outcomes:
                asked.troubled |= asked.asker.machine == machine
                asked.troubled |= hub is None or not hub.alive or hub.machine == machine

    def _leave(self, node: "Node") -> None:
        node.closed = True
        if node in self.nodes:
            self.nodes.remove(node)
        self._kept = [kept for kept in self._kept if kept.node is not node]
        for asked in self.asked:
            asked.troubled |= not asked.outcomes
            if not asked.outcomes and node.process is self.hub and self.dice.random() < NOTICED:
                self._end_soon(asked)
        self.changed()

    def _end_soon(self, asked: Asked) -> None:
        """Tell who asked that the hub is gone."""
        nobody = NobodyThere(f"the hub that {asked.key} was sent to is gone")
        delay = self.dice.uniform(*FAREWELL)
        self.scheduler.after(delay, lambda: asked.end(nobody), asked.asker)

    # Messages.

    def carry(self, source: "Node", target: "Node", key: str, act: Callable[[], None]) -> None:
        """Deliver something after a delay, in the order of its key unless the weather is bad."""
        arrives = self.scheduler.now + self.dice.uniform(*NEAR)
        arrives += self.dice.random() * self.weather.delay
        row = (source, target, key)
        arrives = max(arrives, self._queues.get(row, 0.0) + 1e-6)
        if self.weather.disorder:
            arrives += self.dice.random() * self.weather.disorder
        else:
            self._queues[row] = arrives

        def arrive() -> None:
            if self.linked(target):
                act()

        self.scheduler.after(arrives - self.scheduler.now, arrive, target.process)
        if self.dice.random() < self.weather.twice:
            again = arrives - self.scheduler.now + self.dice.uniform(*RECOVERED)
            self.scheduler.after(again, arrive, target.process)

    def publish(self, node: "Node", key: str, payload: bytes, kept: Kept | None) -> None:
        """Send a message to all subscribers."""
        name = None
        if kept is not None:
            name = (kept.number, kept.sent)
            kept.messages.append((kept.sent, payload))
            kept.sent += 1
        if not self.linked(node):
            return
        for there in self.nodes:
            for one in there.subscriptions if self.linked(there) else ():
                if not matches(one.key, key):
                    continue
                lost = self.dice.random() < self.weather.loss
                if not lost:
                    self.carry(node, there, key, self._deliver(one, key, payload, name))
                elif name is not None and one.kept:
                    self._later(node, one, key, payload, name)

    def recover(self, one: Subscription) -> None:
        """Deliver what is kept and was not delivered to a subscriber yet."""
        for kept in self._kept:
            if matches(one.key, kept.key) and self.linked(kept.node):
                for number, payload in kept.messages:
                    name = (kept.number, number)
                    if name not in one.had:
                        self._later(kept.node, one, kept.key, payload, name)

    def _later(
        self, node: "Node", one: Subscription, key: str, payload: bytes, name: tuple[int, int]
    ) -> None:
        def arrive() -> None:
            if self.linked(node) and self.linked(one.node):
                self._deliver(one, key, payload, name, once=True)()

        delay = self.dice.uniform(*RECOVERED)
        self.scheduler.after(delay, arrive, one.node.process)

    def _deliver(
        self,
        one: Subscription,
        key: str,
        payload: bytes,
        name: tuple[int, int] | None,
        *,
        once: bool = False,
    ) -> Callable[[], None]:
        def arrive() -> None:
            if name is not None and one.kept:
                if once and name in one.had:
                    return
                one.had.add(name)
            one.handler(key, payload)

        return arrive

    def keeping(self, node: "Node", key: str, keep: int) -> Kept:
        kept = Kept(key, node, next(self._keepers), deque(maxlen=keep))
        self._kept.append(kept)
        return kept

    # Requests.

    def request(
        self,
        node: "Node",
        key: str,
        payload: bytes,
        timeout: float,
        done: Callable[[Outcome], None],
    ) -> None:
        asked = Asked(len(self.asked), key, payload, node.process, self.scheduler.now, timeout)
        self.asked.append(asked)

        def end(outcome: Outcome) -> None:
            if not asked.outcomes:
                asked.outcomes.append((self.scheduler.now, outcome))
                done(outcome)

        asked.end = end
        late = TooLate(f"no reply from {key} in time")
        self.scheduler.after(timeout, lambda: end(late), node.process)
        if not self.linked(node):
            asked.troubled = True
            nobody = NobodyThere(f"nobody serves {key}")
            self.scheduler.after(0.001, lambda: end(nobody), node.process)
            return
        servers = [
            (there, handler)
            for there in self.nodes
            for pattern, handler in there.servers
            if matches(pattern, key) and self.linked(there)
        ]
        if not servers:
            asked.troubled = True
            nobody = NobodyThere(f"nobody serves {key}")
            self.scheduler.after(0.002, lambda: end(nobody), node.process)
            return
        if self.dice.random() < self.weather.loss:
            asked.troubled = True
            return
        there, handler = servers[0]

        def arrive() -> None:
            served = Served(key, payload, there.process, self.scheduler.now, timeout)
            self.served.append(served)
            handler(Call(self, served, there, node, asked, end))

        self.carry(node, there, f"? {key} {asked.number}", arrive)

    # Signs of life.

    def _update(self, node: "Node") -> None:
        linked = self.linked(node)
        alive: set[str] = set()
        for there in self.nodes:
            if linked and self.linked(there):
                alive |= set(there.tokens)
        for watch in node.watches:
            now = {key for key in alive if matches(watch.key, key)}
            gone, come = sorted(watch.known - now), sorted(now - watch.known)
            watch.known = now
            for key in gone:
                watch.watcher(key, False)
            for key in come:
                watch.watcher(key, True)
        if linked:
            for one in node.subscriptions:
                if one.kept:
                    self.recover(one)

    def permitted(self, node: "Node", deed: str, key: str) -> None:
        """Note what a node does that its role may not."""
        vehicle, _, tail = key.removeprefix(f"{ROOT}/").partition("/")
        fleet = FLEET.vehicle == vehicle
        allowed = any(
            grant.deed == deed
            and grant.fleet == fleet
            and any(matches(one, tail) for one in grant.tails)
            for grant in ROLES[node.role].grants
        )
        if not allowed:
            self.forbidden.append(f"{node.process.name} ({node.role}) does {deed} {key}")


@dataclass(eq=False)
class Watch:
    key: str
    watcher: Watcher
    known: set[str] = field(default_factory=set)


@dataclass(eq=False)
class Node:
    """One connection to the hub."""

    process: Process
    role: str
    closed: bool = False
    subscriptions: list[Subscription] = field(default_factory=list)
    servers: list[tuple[str, CallHandler]] = field(default_factory=list)
    tokens: list[str] = field(default_factory=list)
    watches: list[Watch] = field(default_factory=list)


class Bus:
    """See bus.interface.Bus."""

    def __init__(self, network: Network, node: Node) -> None:
        self._network, self._node = network, node

    @property
    def linked(self) -> bool:
        return self._network.linked(self._node)

    def publisher(self, key: str, keep: int = 0) -> Publisher:
        self._step("publish-kept" if keep else "publish", key)
        network, node = self._network, self._node
        return _Publisher(self, key, network.keeping(node, key, keep) if keep else None)

    def send(self, key: str, payload: bytes) -> None:
        self._step("publish", key)
        self._network.publish(self._node, key, payload, None)

    def subscribe(self, key: str, handler: Handler, *, kept: bool = False) -> Subscription:
        self._step("subscribe-kept" if kept else "subscribe", key)
        one = Subscription(key, self._node, handler, kept)
        self._node.subscriptions.append(one)
        if kept:
            self._network.recover(one)
        return one

    def serve(self, key: str, handler: CallHandler) -> None:
        self._step("serve", key)
        self._node.servers.append((key, handler))

    def request(
        self, key: str, payload: bytes, timeout: float, done: Callable[[Outcome], None]
    ) -> None:
        self._step("ask", key)
        self._network.request(self._node, key, payload, timeout, done)

    def appear(self, key: str) -> Presence:
        self._step("appear", key)
        self._node.tokens.append(key)
        self._network.changed()
        return _Presence(self._network, self._node, key)

    def watch(self, key: str, watcher: Watcher) -> None:
        self._step("watch", key)
        self._node.watches.append(Watch(key, watcher))
        self._network.changed()

    def close(self) -> None:
        self._network._leave(self._node)

    def _step(self, deed: str, key: str) -> None:
        self._network.scheduler.step()
        self._network.permitted(self._node, deed, key)
        if self._node.closed:
            raise BusFailed("the bus is closed")

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.close()


@dataclass(frozen=True)
class _Publisher:
    bus: Bus
    key: str
    kept: Kept | None

    def put(self, payload: bytes) -> None:
        self.bus._network.scheduler.step()
        self.bus._network.publish(self.bus._node, self.key, payload, self.kept)


@dataclass(frozen=True)
class _Presence:
    network: Network
    node: Node
    key: str

    def withdraw(self) -> None:
        if self.key in self.node.tokens:
            self.node.tokens.remove(self.key)
            self.network.changed()


@dataclass(eq=False)
class Call:
    """See bus.interface.Call."""

    network: Network
    served: Served
    server: Node
    client: Node
    asked: Asked
    end: Callable[[Outcome], Any]

    @property
    def key(self) -> str:
        return self.served.key

    @property
    def payload(self) -> bytes:
        return self.served.payload

    def reply(self, payload: bytes) -> None:
        self._answer("reply", payload)

    def refuse(self, payload: bytes) -> None:
        self._answer("refuse", Refused(payload))

    def drop(self) -> None:
        self._answer("drop", NobodyThere(f"nobody serves {self.key}"))

    def _answer(self, how: str, outcome: Outcome) -> None:
        network = self.network
        network.scheduler.step()
        self.served.ends.append((network.scheduler.now, how))
        if not network.linked(self.server) or network.dice.random() < network.weather.loss:
            self.asked.troubled = True
            return
        key = f"! {self.key} {self.asked.number}"
        network.carry(self.server, self.client, key, lambda: self.end(outcome))
