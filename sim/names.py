"""Names that passengers use for vehicles: numbers, 0 for our own car."""

from collections.abc import Iterable

from sim.scene import EGO

LONGEST = 4  # digits of an id that is a name


class VehicleNames:
    """A number for every vehicle and person, kept for the whole ride.

    The ego is 0. An id that is a positive integer of up to four digits is kept as the number,
    unless it was given away before the id was known. All others get the lowest free number when
    they come into view.
    """

    def __init__(self, ego: str, known: Iterable[str]) -> None:
        """Start naming.

        Args:
            ego: the ego's id.
            known: ids of the ride in the order of the route file. Vehicles that come into view
                together are named in this order. Numbers that are such ids stay reserved.
        """
        ids = tuple(known)
        self._names = {ego: EGO}
        self._order = {vehicle: place for place, vehicle in enumerate(ids)}
        self._taken = {EGO, *(int(vehicle) for vehicle in ids if _is_name(vehicle))}

    def of(self, vehicle: str) -> int:
        """Return the name of a vehicle; it gets one now if it has none."""
        if vehicle not in self._names:
            name = int(vehicle) if self._stands(vehicle) else self._lowest_free()
            self._names[vehicle] = name
            self._taken.add(name)
        return self._names[vehicle]

    def _stands(self, vehicle: str) -> bool:
        """Check whether an id is kept as the name: its number is reserved for it, or still free."""
        return _is_name(vehicle) and (vehicle in self._order or int(vehicle) not in self._taken)

    def in_order(self, vehicles: Iterable[str]) -> list[str]:
        """Return vehicles in the order in which they are to be named."""
        last = len(self._order)
        return sorted(vehicles, key=lambda vehicle: (self._order.get(vehicle, last), vehicle))

    def _lowest_free(self) -> int:
        name = 1
        while name in self._taken:
            name += 1
        return name


def _is_name(vehicle: str) -> bool:
    """Check whether an id is a positive integer that is short enough to be said."""
    plain = vehicle.isascii() and vehicle.isdigit() and vehicle[0] != "0"
    return plain and len(vehicle) <= LONGEST
