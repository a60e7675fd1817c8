"""What is told of a run: shares by room, and the reasons that the page gives."""

from tests.mutants.faults import Fault, faults_of
from tests.mutants.plugin import Trial
from tests.mutants.report import reasons, share, survivors, table

SOURCE = "def f(x, y):\n    return x < 2 or y | x\n"


def fault(after: str) -> Fault:
    return next(f for f in faults_of("a.py", SOURCE, "room") if f.after == after)


NOTICED = Trial(fault("x <= 2"), "tests/test_a.py::test_it", 3, 0.5)
RUN = Trial(fault("x >= 2"), "", 3, 0.5)
NEVER_RUN = Trial(fault("y & x"), "", 0, 0.0)


def test_shares_are_told_by_room() -> None:
    assert share([NOTICED, RUN, NEVER_RUN, NOTICED]) == 0.5
    assert table([NOTICED, RUN, NEVER_RUN])[2:] == [
        "| room | 3 | 2 | 1 | 33% |",
        "| all | 3 | 2 | 1 | 33.3% |",
    ]


def test_reasons_stand_in_the_table_of_the_page() -> None:
    name = NEVER_RUN.fault.name
    assert name == "a.py:f: y ¦ x → y & x"
    page = f"# A page\n\n| fault | reason |\n|---|---|\n| `{name}` | gap: nobody runs it |\n"
    known = reasons(page)
    assert known == {name: "gap: nobody runs it"}
    assert survivors([NOTICED, RUN, NEVER_RUN], known) == [
        f"a.py:2 {RUN.fault.name} [no reason given]",
        f"a.py:2 {name} [gap: nobody runs it]",
    ]
