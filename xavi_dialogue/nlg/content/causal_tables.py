"""Tables: the planner of each type of causal answer, and of refusals."""

from xavi_dialogue.domain import answers, hidden_areas, traffic_lights
from xavi_dialogue.nlg.content import insights, refusals
from xavi_dialogue.nlg.content.clarifications import plan_which_one
from xavi_dialogue.nlg.content.corrections import plan_did_not_happen
from xavi_dialogue.nlg.content.going import plan_going, plan_unslowed
from xavi_dialogue.nlg.content.hidden_areas import plan_seeing
from xavi_dialogue.nlg.content.motives import plan_motion
from xavi_dialogue.nlg.content.others import plan_other, plan_place, plan_signal
from xavi_dialogue.nlg.content.own_suppositions import plan_supposed_of_us
from xavi_dialogue.nlg.content.plan import Planner
from xavi_dialogue.nlg.content.reactions import plan_reaction
from xavi_dialogue.nlg.content.reasons import plan_choice
from xavi_dialogue.nlg.content.signals import plan_own_signal
from xavi_dialogue.nlg.content.suppositions import plan_supposed_of_other
from xavi_dialogue.nlg.content.suspects import plan_nobody_else
from xavi_dialogue.nlg.content.traffic_lights import plan_supposed_light

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
    answers.Pivot: insights.plan_pivot,
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
