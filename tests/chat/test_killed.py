"""Golden conversations, killed after every answer and resumed from disk: the same bytes.

`tests/test_transcripts.py` sees to it that those which nobody kills are as they are written.
"""

import time
from pathlib import Path

import pytest

from xavi_dialogue.dialogue.manager import fold
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.dialogue.state.events import (
    EventRecorded,
    Input,
    Resumed,
    RideEnded,
    TraceRecorded,
)
from xavi_dialogue.dialogue.state.state import Dialogue
from xavi_dialogue.dialogue.state.states import Phase
from xavi_dialogue.nlg.context import Style
from xavi_dialogue.service.in_process import SESSION, Conversation, make_pipeline
from xavi_dialogue.storage.conversations import NewTurn, Store
from xavi_dialogue.transcripts.replay import Written, recording, replay_recorded, transcripts_in
from xavi_dialogue.transcripts.transcript import write

TRANSCRIPTS = transcripts_in(Path(__file__).parents[2] / "transcripts")
PIPELINE = make_pipeline()


def record_of(dialogue: Dialogue) -> tuple[Input, ...]:
    """The ride as it is reported anew."""
    over = () if dialogue.ended_at is None else (RideEnded(dialogue.ended_at),)
    return (
        *map(TraceRecorded, dialogue.traces),
        *map(EventRecorded, dialogue.events),
        *over,
    )


@pytest.mark.parametrize("one", TRANSCRIPTS, ids=lambda one: one.path.stem)
def test_a_conversation_that_is_killed_after_every_answer_is_the_same(
    one: Written, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    store = Store(tmp_path / "dialogue.sqlite3")
    ask = Conversation.ask

    def ask_anew(self: Conversation, text: str, at: float, style: Style = "passenger") -> Reply:
        before = store.turns(SESSION, 200)
        resumed = (Resumed(SESSION, before),) if before else ()
        if self.dialogue.session(SESSION).phase is not Phase.PLANNING:  # else it is turned away
            self.dialogue = fold(self.pipeline, (*record_of(self.dialogue), *resumed))
        reply = ask(self, text, at, style)
        turn = self.dialogue.sessions[SESSION].turns[-1]
        store.keep([NewTurn(SESSION, None, time.time(), turn)])
        assert store.turns(SESSION, 1) == (turn,)
        return reply

    monkeypatch.setattr(Conversation, "ask", ask_anew)
    played = replay_recorded(one.transcript, recording(one.ride), PIPELINE)
    assert write(played.transcript) == one.text
    assert store.sessions()[0].turns > 0
    store.close()
