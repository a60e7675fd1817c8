"""What is said in another way of spoken English is read like the plain question."""

from collections import Counter

from tests.nlu import constructions

EVERY = 4  # of the texts one in so many is read
LEAST = 0.94  # share of texts read as meant
DECLINED = 0.02


def test_constructions_are_read_as_meant() -> None:
    cases = list(constructions.cases())[::EVERY]
    ends = Counter(constructions.outcome(case) for case in cases)
    assert ends[""] >= LEAST * len(cases), "see: python -m tests.nlu.constructions -v"
    assert ends[constructions.DECLINED] <= DECLINED * len(cases)


def test_there_are_many_constructions() -> None:
    frames = {(case.group, case.frame) for case in constructions.cases()}
    assert len(frames) >= 200
    assert len({group for group, _ in frames}) >= 15
