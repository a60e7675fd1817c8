"""Tables: which function plans the messages of each type of causal answer and of refusal."""

from xavi_dialogue.domain import answers, hidden_areas, traffic_lights
from xavi_dialogue.nlg.content.clauses.plan import Planner
from xavi_dialogue.nlg.content.clauses.traffic_lights import plan_supposed_light
from xavi_dialogue.nlg.content.observed.corrections import plan_did_not_happen
from xavi_dialogue.nlg.content.reasons import insights
from xavi_dialogue.nlg.content.reasons.going import plan_going, plan_unslowed
from xavi_dialogue.nlg.content.reasons.hidden_areas import plan_seeing
from xavi_dialogue.nlg.content.reasons.motives import plan_motion
from xavi_dialogue.nlg.content.reasons.others import plan_other, plan_place, plan_signal
from xavi_dialogue.nlg.content.reasons.own_suppositions import plan_supposed_of_us
from xavi_dialogue.nlg.content.reasons.reactions import plan_reaction
from xavi_dialogue.nlg.content.reasons.reasons import plan_choice
from xavi_dialogue.nlg.content.reasons.signals import plan_own_signal
from xavi_dialogue.nlg.content.reasons.suppositions import plan_supposed_of_other
from xavi_dialogue.nlg.content.reasons.suspects import plan_nobody_else
from xavi_dialogue.nlg.content.talk import refusals
from xavi_dialogue.nlg.content.talk.clarifications import plan_which_one

CAUSES: dict[type, Planner] = {
    answers.ChoiceReason: plan_choice,
    answers.MotionReason: plan_motion,
    answers.NobodyElse: plan_nobody_else,
    answers.GoReason: plan_going,
    answers.Unslowed: plan_unslowed,
    answers.OtherReason: plan_other,
    answers.SignalReason: plan_signal,
    answers.OwnSignal: plan_own_signal,
    answers.PlaceReason: plan_place,
    answers.SupposedOfUs: plan_supposed_of_us,
    answers.SupposedOfOther: plan_supposed_of_other,
    answers.Reaction: plan_reaction,
    traffic_lights.SupposedOfLight: plan_supposed_light,
    hidden_areas.SupposedSeeing: plan_seeing,
    answers.Grounds: insights.plan_grounds,
    answers.Certainty: insights.plan_certainty,
    answers.Method: insights.plan_method,
    answers.DecisiveFactor: insights.plan_pivot,
    answers.Avoidance: insights.plan_avoidance,
}
REFUSALS: dict[type, Planner] = {
    answers.NotUnderstood: refusals.plan_not_understood,
    answers.WhichOne: plan_which_one,
    answers.NoSuchVehicle: refusals.plan_no_such_vehicle,
    answers.DidNotHappen: plan_did_not_happen,
    answers.NotApplicable: refusals.plan_not_applicable,
    answers.TooLittle: refusals.plan_too_little,
    answers.NotRecorded: refusals.plan_not_recorded,
    answers.CannotSay: refusals.plan_cannot_say,
    answers.Unavailable: refusals.plan_unavailable,
}
