"""Tenses: the tense of a statement, by its time and by the question."""

from xavi_dialogue.domain import terms
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import At, Between, Event, Next, Now, Time, WholeRide, Within
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.values import Clause, Moment, Tense

PRESENT = 1.0  # [s] maximum age of what counts as now ...
#: Actions whose end is seen at once.
SEEN_OVER = frozenset(("brake", "slow-down", "speed-up", "stop", "stand", "wait", "give-way"))
#: Actions at junctions, of which there are several.
TURNS = frozenset(
    ("turn", "exit-left", "exit-right", "exit-straight", "continue-next-exit", "enter", "leave",
     "let-go")
)  # fmt: skip
OLD = 6.0  # [s] minimum age of a past event whose time is stated ...
NAMED = 0.3  # [s] ... if that time was named in the question


def since(context: SpeechContext) -> float:
    """Return the age [s] from which something is past."""
    return NAMED if context.then else PRESENT


def goes_on(episode: Episode, now: float) -> bool:
    """Check whether an episode goes on, or ended only just now."""
    just_over = episode.end is not None and now - episode.end <= PRESENT
    return episode.end is None or (just_over and episode.action not in SEEN_OVER)


def dated(clause: Clause, episode: Episode, context: SpeechContext) -> Clause:
    """Add its time to a past clause of slowing, waiting or turning, unless it ended only just now.

    It may not be the one that the passenger means, so this holds even if a time or place was named.
    """
    begun = began(episode, context)
    if begun is None or clause.tense != "past":
        return clause
    rest = (*clause.rest, begun)
    return Clause(clause.subject, clause.verb, rest, "past", clause.progressive, clause.negated)


def began(episode: Episode, context: SpeechContext) -> Moment | None:
    """Return when something began of which there may be several, and that is not only just over."""
    repeated = episode.action in SEEN_OVER or episode.action in TURNS
    old = repeated and episode.end is not None and context.now - episode.end > OLD
    return Moment(episode.begin) if old else None


def tense_at(time: float, now: float, present: float = PRESENT) -> Tense:
    """Return the tense in which a state at a time of the ride is stated."""
    if time > now + PRESENT:
        return "future"
    return "past" if now - time > present else "present"


def tense_of(tense: terms.Tense, time: Time, now: float) -> Tense:
    """Return the tense of a proposition: that of the question, corrected by its time."""
    match time:
        case At(at=at):
            behind = tense in ("past", "perfect") and now - at > NAMED
            return "past" if behind else tense_at(at, now)
        case Between(begin=begin, end=end):
            over = now - end > (NAMED if tense == "present" else PRESENT)
            return "future" if begin > now else "past" if over else tense
        case Now():
            return "present"
        case Next() | Within():
            return "future"
        case WholeRide():
            return "past" if tense == "present" else tense
    return tense


def moment_of(time: Time) -> float | None:
    """Return the time of the ride at which things look as they are described."""
    match time:
        case At(at=at):
            return at
        case Between(begin=begin):
            return begin
    return None


def event_tense(event: Event, now: float) -> tuple[Tense, str | None]:
    """Return the tense and the modal verb of an event."""
    tense = tense_of(event.tense, event.time, now)
    match event.modal:
        case None | "will":
            return ("future" if event.modal else tense), None
        case "would":
            return ("conditional-perfect" if tense in ("past", "perfect") else "conditional"), None
        case "want":
            return tense, None
    return tense, event.modal
