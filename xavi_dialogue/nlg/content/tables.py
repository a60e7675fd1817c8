"""Tables: which function plans the messages of each type of factual answer and of talk."""

from xavi_dialogue.domain import answers, hidden_areas, traffic_lights
from xavi_dialogue.nlg.content.clauses import traffic_lights as lights
from xavi_dialogue.nlg.content.clauses.joint_measures import (
    plan_lasted,
    plan_measures,
    plan_staying,
)
from xavi_dialogue.nlg.content.clauses.plan import Planner
from xavi_dialogue.nlg.content.observed import (
    beliefs,
    conduct,
    courses,
    dangers,
    peak_moments,
    people,
    safety,
    simulations,
    turns,
    whereabouts,
)
from xavi_dialogue.nlg.content.observed.happenings import plan_happenings
from xavi_dialogue.nlg.content.observed.verdicts import plan_verdict
from xavi_dialogue.nlg.content.reasons.hidden_areas import plan_all_round, plan_sight
from xavi_dialogue.nlg.content.talk import clarifications, quizzes, requests, talk

FACTS: dict[type, Planner] = {
    answers.Measures: plan_measures,
    answers.Verdict: plan_verdict,
    answers.Identified: people.plan_identified,
    answers.Counted: people.plan_counted,
    answers.Located: whereabouts.plan_located,
    answers.Happenings: plan_happenings,
    answers.Lasted: plan_lasted,
    answers.Staying: plan_staying,
    traffic_lights.LightTold: lights.plan_light,
    traffic_lights.LightForeseen: lights.plan_foreseen,
    traffic_lights.LightPassed: lights.plan_passed,
    traffic_lights.TurnOnRed: lights.plan_turn_on_red,
    hidden_areas.SightTold: plan_sight,
    hidden_areas.AllRound: plan_all_round,
    answers.Activity: conduct.plan_activity,
    answers.PlanAhead: conduct.plan_ahead,
    answers.Bound: conduct.plan_bound,
    answers.Forecast: conduct.plan_forecast,
    answers.Course: courses.plan_course,
    answers.LaneFits: courses.plan_lane_fits,
    answers.PeakMoment: peak_moments.plan_peak_moment,
    answers.Decided: peak_moments.plan_decided,
    answers.Altered: peak_moments.plan_altered,
    answers.Wavered: peak_moments.plan_wavered,
    answers.Beliefs: beliefs.plan_beliefs,
    answers.Simulations: simulations.plan_simulations,
    answers.Options: beliefs.plan_options,
    answers.Compared: beliefs.plan_compared,
    answers.Priority: safety.plan_priority,
    answers.Comfort: safety.plan_comfort,
    answers.Closeness: safety.plan_closeness,
    answers.PullingUp: dangers.plan_pulling_up,
    answers.Slowing: dangers.plan_slowing,
    answers.Unblocking: turns.plan_unblocking,
    answers.Comforting: talk.plan_comforting,
    answers.Declined: requests.plan_declined,
    answers.Sociable: talk.plan_sociable,
    answers.Helpful: talk.plan_helpful,
    answers.Acknowledged: talk.plan_acknowledged,
    answers.Again: talk.plan_again,
    answers.TakenAs: clarifications.plan_taken_as,
    answers.Unfamiliar: clarifications.plan_unfamiliar,
    answers.Posed: quizzes.plan_posed,
    answers.Judged: quizzes.plan_judged,
    answers.NothingToAsk: quizzes.plan_nothing_to_ask,
}
