"""What is loaded is spared from collections while a ride goes on."""

import gc

import pytest

from xavi_dialogue.process.garbage import settled


def test_what_is_loaded_is_spared_until_the_ride_is_over() -> None:
    with settled():
        assert gc.get_freeze_count() > 1000
    assert gc.get_freeze_count() == 0


def test_it_is_gone_through_again_after_a_failure() -> None:
    with pytest.raises(ValueError), settled():
        raise ValueError
    assert gc.get_freeze_count() == 0
