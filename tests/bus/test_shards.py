"""Shards of a fleet: each car has one home, and of several claims the first holds."""

import pytest

from xavi_dialogue.bus.shards import Claim, Shard, after, holder, home, missing

CARS = [f"shuttle-{number}" for number in range(2000)]


def test_a_car_is_of_one_shard_alone() -> None:
    shards = [Shard(number, 4) for number in (1, 2, 3, 4)]
    assert all(sum(shard.has(car) for shard in shards) == 1 for car in CARS)


def test_shards_are_about_as_large_as_one_another() -> None:
    sizes = [sum(home(car, 4) == number for car in CARS) for number in (1, 2, 3, 4)]
    assert min(sizes) > 400
    assert max(sizes) < 600


def test_with_one_shard_more_only_its_own_cars_move() -> None:
    moved = [car for car in CARS if home(car, 4) != home(car, 5)]
    assert {home(car, 5) for car in moved} == {5}
    assert len(moved) == pytest.approx(len(CARS) / 5, rel=0.2)


def test_the_home_of_a_car_is_the_same_for_all_versions() -> None:
    assert [home(car, 4) for car in ("car", "shuttle-1", "shuttle-2", "shuttle-3")] == [4, 4, 3, 2]


@pytest.mark.parametrize(
    "text", ["0/4", "5/4", "2", "2/", "a/b", "1/1001", "-1/4", "1/4/2", "", "١/٢"]
)
def test_what_is_no_shard_is_not_read(text: str) -> None:
    with pytest.raises(ValueError, match="no shard"):
        Shard.read(text)


def test_a_claim_is_read_from_its_key() -> None:
    claim = Claim(7, "9f31c2aa", Shard(2, 4))
    assert Claim.read(claim.key) == claim
    assert Claim.read("xavi/v1/@fleet/service/7.9f31c2aa.5.4") is None
    assert Claim.read("xavi/v1/@fleet/service/nonsense") is None


def test_the_first_claim_to_a_car_holds() -> None:
    first = after((), "zz", Shard())
    second = after((first,), "aa", Shard())
    assert holder((second, first), "car") == first
    assert holder((second,), "car") == second


def test_of_claims_that_were_made_at_once_one_holds() -> None:
    one, other = after((), "aa", Shard()), after((), "bb", Shard())
    assert holder((one, other), "car") == holder((other, one), "car") == one


def test_shards_without_a_service_are_missing() -> None:
    claims = [Claim(1, "a", Shard(1, 3)), Claim(2, "b", Shard(3, 3))]
    assert missing(claims) == [Shard(2, 3)]
    assert holder(claims, next(car for car in CARS if home(car, 3) == 2)) is None
    assert missing([Claim(1, "a")]) == []
