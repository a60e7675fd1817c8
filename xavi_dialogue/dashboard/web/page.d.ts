// Written by page_types.py: what the page receives. SI units, radians, seconds.

/** A first action, the chosen one among them. */
interface Alternative {
  action: "change-left" | "change-right" | "continue" | "continue-next-exit" | "cross" | "exit-left" | "exit-right" | "exit-straight" | "stop";
  words: string;
  chosen: boolean;
  outcomes: Record<string, number>;
  time: TimeRange | null;
  arrival: number | null;
  value: number | null;
  rollouts: number;
  distinct: number;
  line: Drive | null;
  reason: string | null;
}

/** The result of a question, for the browser that asked. */
interface AnsweredHere {
  type: "answered";
  request: string;
  n: number | null;
  reply: Reply | null;
}

/** The prediction of one other vehicle. */
interface Belief {
  vehicle: number;
  goals: [string, number][];
}

/** One action at one node of the search tree. */
interface Branch {
  action: "change-left" | "change-right" | "continue" | "continue-next-exit" | "cross" | "exit-left" | "exit-right" | "exit-straight" | "stop";
  words: string;
  chosen: boolean;
  visits: number;
  forced: number;
  value: number | null;
  arrival: number | null;
  outcomes: Record<string, number>;
  held_up: [number, string, number][];
  children: Branch[];
  refused: (["change-left" | "change-right" | "continue" | "continue-next-exit" | "cross" | "exit-left" | "exit-right" | "exit-straight" | "stop", string])[];
}

/** One vehicle that is a cause. */
interface CauseShown {
  vehicle: number;
  words: string;
  probability: number;
  how: string | null;
  influence: number | null;
  checked: string | null;
}

/** A pedestrian crossing. */
interface CrossingShown {
  line: number[];
  width: number;
  signal: string | null;
}

/** One decision, in short. */
interface Decision {
  id: string;
  t: number;
  number: number;
  plan: ("change-left" | "change-right" | "continue" | "continue-next-exit" | "cross" | "exit-left" | "exit-right" | "exit-straight" | "stop")[];
  words: string;
  changed: boolean;
  beliefs: Belief[];
}

/** GET /api/decisions/ID: one decision, whole. */
interface DecisionShown {
  id: string;
  t: number;
  number: number;
  seed: number;
  words: string;
  plan: (["change-left" | "change-right" | "continue" | "continue-next-exit" | "cross" | "exit-left" | "exit-right" | "exit-straight" | "stop", string, number, number])[];
  under_way: string | null;
  goal: [number, number] | null;
  view_radius: number;
  ego: Drive | null;
  alternatives: Alternative[];
  predictions: Predicted[];
  root: Branch[];
  refused: (["change-left" | "change-right" | "continue" | "continue-next-exit" | "cross" | "exit-left" | "exit-right" | "exit-straight" | "stop", string])[];
  right_of_way: RightOfWay | null;
  imagined: ImaginedShown[];
  rollouts: number;
}

/** Decisions that the browser does not know yet, in order of time. */
interface Decisions {
  type: "decisions";
  decisions: Decision[];
}

/** A line that is or would be driven. */
interface Drive {
  t: number;
  dt: number;
  path: number[];
  speed: number[];
  outcome?: string | null;
  probability?: number;
  collided_with?: number | null;
}

/** One effect: counterfactual minus factual. */
interface EffectShown {
  words: string;
  unit: string;
  delta: number;
  low: number;
  high: number;
  n: number;
  n_distinct: number;
}

/** Events that the browser does not know yet, in order of time. */
interface Events {
  type: "events";
  events: Happened[];
}

/** GET /api/turns/N/evidence: the evidence of an answer. */
interface EvidenceShown {
  n: number;
  decision: string;
  t: number;
  method: string;
  rollouts: number;
  distinct: number;
  factual: Side | null;
  counterfactual: Side | null;
  effects: EffectShown[];
  causes: CauseShown[];
  traces: string[];
  missing: string | null;
}

/** A possible goal of another vehicle. */
interface GoalShown {
  kind: "change-left" | "change-right" | "continue" | "continue-next-exit" | "cross" | "exit-left" | "exit-right" | "exit-straight" | "stop";
  words: string;
  place: string;
  prior: number;
  probability: number;
  ways: Way[];
}

/** One event. */
interface Happened {
  t: number;
  kind: string;
  action: "change-left" | "change-right" | "continue" | "continue-next-exit" | "cross" | "exit-left" | "exit-right" | "exit-straight" | "stop" | null;
  vehicle: number | null;
  words: string;
}

/** A road user that may come out of a hidden stretch of road. */
interface ImaginedShown {
  position: [number, number];
  heading: number;
  probability: number;
  behind: number | null;
}

/** One lane. */
interface LaneShown {
  id: string;
  edge: string;
  index: number;
  width: number;
  internal: boolean;
  line: number[];
  use?: string;
}

/** One way through a junction. */
interface LinkShown {
  id: number;
  junction: string;
  from_lane: string;
  to_lane: string;
  via: string[];
  direction: string;
  yields_to: number[];
  signal?: string | null;
}

/** GET /api/past: the scenes of this ride so far, at most 5 a second. */
interface Past {
  ride: string;
  scenes: ([number, ([number, number, number, number, number, number, number, string, string | null, string[]])[], [string, string][] | null, [string, number, number][] | null])[];
}

/** The prediction of another vehicle. */
interface Predicted {
  vehicle: number;
  goals: GoalShown[];
}

/** What a question asks, as flat fields: a projection of its first act, for scoring alone. */
interface QueryFields {
  type: "ambiguous" | "compare" | "confidence" | "help" | "how" | "how_avoid" | "out_of_scope" | "sensitivity" | "smalltalk" | "what" | "what_if" | "when" | "where_goal" | "why" | "why_not";
  actor?: string;
  factual?: ("change-left" | "change-right" | "continue" | "continue-next-exit" | "exit-left" | "exit-right" | "exit-straight" | "give-way" | "overtake" | "slow-down" | "speed-up" | "stop")[] | null;
  counterfactual?: ("change-left" | "change-right" | "continue" | "continue-next-exit" | "exit-left" | "exit-right" | "exit-straight" | "give-way" | "overtake" | "slow-down" | "speed-up" | "stop")[] | null;
  negated?: boolean;
  tense?: "future" | "past" | "present";
  time?: string | null;
  detail?: "less" | "more" | null;
  refers_to_previous?: boolean;
  reason?: string | null;
  event?: string | null;
  hypothesised_cause?: string | null;
  intervention?: string | null;
  condition?: string | null;
  compound?: boolean | null;
  underspecified?: string | null;
}

/** What the car says, and what it rests on. All keys are always there. */
interface Reply {
  schema?: "xavi.reply/2";
  text: string;
  kind: "answer" | "clarification" | "refusal";
  reason?: "ambiguous" | "busy" | "did-not-happen" | "effect-too-small" | "no-influence" | "not-an-action" | "not-applicable" | "not-understood" | "out-of-scope" | "outside-record" | "planner-failed" | "planner-unavailable" | "timed-out" | "too-little-evidence" | "trace-gap" | "unknown-vehicle" | null;
  query?: QueryFields | null;
  explanation?: Record<string, any> | null;
  acts?: Record<string, any>[];
  answers?: Record<string, any>[];
  choices?: string[];
  suggestions?: string[];
  trace_id?: string | null;
  sim_time: number;
  timing_ms?: number | null;
}

/** A ride begins, or is under way; it replaces any other ride. */
interface Ride {
  type: "ride";
  ride: string;
  scenario: string | null;
  seed: number | null;
  roads: string | null;
}

/** Right of way at the next junction. */
interface RightOfWay {
  junction: string;
  ego: number;
  goes_first: number[];
  vehicles: number[];
}

/** GET /api/roads/HASH: the network. */
interface Roads {
  hash: string;
  bounds: [number, number, number, number];
  lanes: LaneShown[];
  links: LinkShown[];
  junctions: number[][];
  others?: LaneShown[];
  crossings?: CrossingShown[];
}

/** A rollout, and how often one like it was drawn. */
interface Run {
  index: number;
  draws: number;
  words: string;
  outcome: string;
  arrival: number | null;
  samples: [number, string, number][];
  held_up: [number, string, number][];
  collided_with: number | null;
}

/** The present scene, up to 10 times a second; a slow browser gets fewer. */
interface SceneShown {
  type: "scene";
  seq: number;
  t: number;
  wall: number;
  state: "driving" | "ended" | "paused";
  speed: number;
  plan: ("change-left" | "change-right" | "continue" | "continue-next-exit" | "cross" | "exit-left" | "exit-right" | "exit-straight" | "stop")[];
  vehicles: ([number, number, number, number, number, number, number, string, string | null, string[]])[];
  lights?: [string, string][];
  hidden?: [string, number, number][];
}

/** One side of a contrast: the fact or the foil. */
interface Side {
  title: string;
  brief: string;
  words: string;
  outcomes: Record<string, number>;
  arrival: number | null;
  lines: Drive[];
  runs: Run[];
  rollouts: number;
}

/** The state of the connections. Sent with the welcome, and after every change. */
interface Status {
  type: "status";
  hub: "awaited" | "coming" | "gone" | "there";
  car: "awaited" | "coming" | "gone" | "there";
  service: "awaited" | "coming" | "gone" | "there";
  dropped: number;
  browsers: number;
}

/** Suggested questions, most interesting first, about what has just happened. */
interface Suggestions {
  type: "suggestions";
  t: number;
  questions: string[];
}

/** A question was sent to the service; for the browser that asked. */
interface Thinking {
  type: "thinking";
  request: string;
}

/** A difference in time to the goal [s] against the chosen plan; positive: later. */
interface TimeRange {
  delta: number;
  low: number;
  high: number;
}

/** A message of the browser was rejected; the reason is a text for users. */
interface Trouble {
  type: "trouble";
  request: string | null;
  text: string;
}

/** One turn of the conversation. */
interface TurnShown {
  n: number;
  text: string;
  reply: Reply;
  vehicles: number[];
  evidence: boolean;
}

/** Turns that are new to the browser, from any client; `reset`: drop those before. */
interface Turns {
  type: "turns";
  turns: TurnShown[];
  reset?: boolean;
}

/** A way in which a vehicle may reach a goal. */
interface Way {
  probability: number;
  line: Drive | null;
}

/** The first message of every connection. */
interface Welcome {
  type: "welcome";
  version: string;
  vehicle: string;
  session: string;
  recording?: boolean;
  max_text?: number;
}
