"""How faults are drawn: by the seed, by lines, and from every room."""

from collections import Counter

from tests.mutants import rooms
from tests.mutants.faults import Fault, drawn, every, faults_of, shares


def many(room: str, lines: int) -> list[Fault]:
    source = "".join(f"x = {k} + y < z\n" for k in range(2, lines + 2))
    return faults_of(f"{room}.py", source, room)


def test_every_room_has_its_share_but_not_less_than_the_least() -> None:
    assert shares({"small": 50, "middle": 1000, "large": 3000}, 300, least=30) == {
        "small": 30,
        "middle": 68,
        "large": 202,
    }
    assert shares({"tiny": 7, "large": 900}, 100, least=30) == {"tiny": 7, "large": 93}


def test_the_seed_alone_decides() -> None:
    found = [*many("one", 100), *many("other", 400)]
    assert drawn(found, 100, 0) == drawn(found, 100, 0)
    assert drawn(found, 100, 0) != drawn(found, 100, 1)


def test_no_line_is_drawn_twice_and_each_as_often_as_others() -> None:
    found = many("one", 20)
    counts = Counter(fault.line for seed in range(400) for fault in drawn(found, 10, seed))
    assert set(counts) == set(range(1, 21))
    assert all(150 < count < 250 for count in counts.values())
    assert all(len({f.line for f in drawn(found, 10, seed)}) == 10 for seed in range(20))


def test_every_room_has_faults() -> None:
    assert {fault.room for fault in every()} == set(rooms.ROOMS)


def test_the_name_of_a_fault_does_not_change_with_its_line() -> None:
    (one, *_), (other, *_) = (
        faults_of("a.py", f"{blank}def f(x):\n    return x < 2\n", "a") for blank in ("", "\n\n")
    )
    assert one.line != other.line
    assert one.name == other.name == "a.py:f: return x < 2 → return None"
