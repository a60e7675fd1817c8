"""Names that passengers use for vehicles: numbers, 0 for our own car."""

from collections.abc import Iterable

from sim.scene import EGO

LONGEST = 4  # digits of an id that is a name


class VehicleNames:
    """Gives every vehicle a number and keeps it.

    The ego is 0; another id that is a positive integer of at most four digits stands; the rest
    get the lowest free number as they come into view.
    """

    def __init__(self, ego: str, known: Iterable[str]) -> None:
        """Start naming.

        Args:
            ego: the ego's id.
            known: ids of the ride in the order of the route file. Vehicles that come into view
                together are named in this order, and numbers that are ids are never given away.
        """
        ids = tuple(known)
        self._names = {ego: EGO}
        self._order = {vehicle: place for place, vehicle in enumerate(ids)}
        self._taken = {EGO, *(int(vehicle) for vehicle in ids if _is_name(vehicle))}

    def of(self, vehicle: str) -> int:
        """Return the name of a vehicle, given now if it has none."""
        if vehicle not in self._names:
            name = int(vehicle) if self._stands(vehicle) else self._lowest_free()
            self._names[vehicle] = name
            self._taken.add(name)
        return self._names[vehicle]

    def _stands(self, vehicle: str) -> bool:
        """Check whether an id is its own name: nobody got that number before it was known."""
        return _is_name(vehicle) and (vehicle in self._order or int(vehicle) not in self._taken)

    def in_order(self, vehicles: Iterable[str]) -> list[str]:
        """Vehicles in the order in which they are to be named."""
        last = len(self._order)
        return sorted(vehicles, key=lambda vehicle: (self._order.get(vehicle, last), vehicle))

    def _lowest_free(self) -> int:
        name = 1
        while name in self._taken:
            name += 1
        return name


def _is_name(vehicle: str) -> bool:
    """Check whether an id is short enough to be said."""
    plain = vehicle.isascii() and vehicle.isdigit() and vehicle[0] != "0"
    return plain and len(vehicle) <= LONGEST
