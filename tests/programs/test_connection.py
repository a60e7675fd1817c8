"""A car on a real bus, asked by programs that wait and by those that do not."""

import asyncio
from collections.abc import Iterator

import pytest

import xavi_dialogue as xavi
from tests.programs.test_client_example import served

pytestmark = pytest.mark.slow

WHERE = "Where are you going?"


@pytest.fixture(scope="module")
def hub() -> Iterator[str]:
    """The endpoint of a service with a car that has driven a while."""
    with served() as endpoint:
        with xavi.connect(endpoint, patience=120.0) as car:
            met = car._client.wait_for(lambda scene: scene.sim_time > 7.0, lambda: None, 120.0)
            assert met is not None
        yield endpoint


def test_a_program_that_waits(hub: str) -> None:
    with xavi.connect(hub) as car:
        assert car._repr_html_() == f"<p>Car car, conversation {car.session}</p>"
        assert car.now is not None
        assert car.now > 7.0
        answer = car.ask("Why did you change left?")
        assert answer.text.startswith("I moved to the left lane, because")
        assert answer.decision is not None
        assert answer.decision.time == 3.0
        assert answer.decision.plan[0] == "change-left"
        assert answer.ghost is not None
        assert answer.map is not None
        follow_up = car.ask("and if it had not been there?")
        assert follow_up.text == "Without the blue car, I would have stayed in my lane instead."
        assert car.answers == (answer, follow_up)
        assert car._repr_html_() == answer._repr_html_() + follow_up._repr_html_()
        session = car.session
    with xavi.connect(hub, session=session) as again:  # the conversation goes on
        assert again.ask("what did I ask first?").kind != "refusal"
        for wrong, told in (
            ((None,), "the question is None; give a text"),
            ((WHERE, "8"), r"at is '8'; give a time \[s\] of the ride"),
            ((WHERE, float("nan")), r"at is nan; give a time \[s\] of the ride"),
            ((WHERE, None, "rude"), "there is no style 'rude'"),
        ):
            with pytest.raises(xavi.XaviError, match=told):
                again.ask(*wrong)  # type: ignore[arg-type]
    with pytest.raises(xavi.XaviError):
        car.ask(WHERE)


def test_a_program_that_does_not_wait(hub: str) -> None:
    async def program() -> list[xavi.Answer]:
        async with await xavi.connect_async(hub) as car:
            first = await car.ask_async("Why did you change left?")
            taken_back = asyncio.create_task(car.ask_async(WHERE))
            await asyncio.sleep(0)
            taken_back.cancel()
            with pytest.raises(asyncio.CancelledError):
                await taken_back
            return [first, *await asyncio.gather(car.ask_async(WHERE, 5.0))]

    first, second = asyncio.run(program())
    assert first.text.startswith("I moved to the left lane, because")
    assert (second.kind, second.at) == ("answer", 5.0)


def test_where_there_is_no_hub_or_car(hub: str) -> None:
    with pytest.raises(xavi.XaviError, match="'nobody'"):
        xavi.connect(hub, vehicle="nobody", patience=1.0)
    with pytest.raises(xavi.XaviError):
        xavi.connect("tcp/127.0.0.1:1", patience=1.0)
