/** What the whole page says where something is not there: a card over the empty map, or a strip above it. */
import { drawing, fill, h, on } from "./dom.js";
import { standing } from "./standing.js";

/** By name: drawing, headline, and what it means: a text with `code`, or a function that makes it. */
const STATES = {
  connecting: ["connecting", "Connecting …", "to the dashboard on this address."],
  unreachable: [
    "unreachable",
    "The dashboard does not answer",
    "It may have been stopped. Start it with `xavi dashboard`; this page goes on trying and needs no reload.",
  ],
  refused: ["unreachable", "Not let in", (_, connection) => connection.words],
  hub: [
    "hub",
    "Waiting for the hub",
    "Car, service and this page meet at a hub, and it is not there yet. A service brings one: `xavi serve`. " +
      "This page goes on by itself.",
  ],
  hubGone: [
    "hub",
    "The hub is gone.",
    "Nothing new is heard. What was seen is still here: you can scrub back and look at every decision.",
  ],
  car: [
    "car",
    "Waiting for the car",
    ({ welcome }) => [
      ["Nobody by the name of ", h("b", welcome?.vehicle ?? "car"), " drives yet. "],
      withCode("Start one with `xavi drive --connect …`, or `xavi dashboard --scenario s1` to have all in one."),
    ],
  ],
  coming: ["coming", "The car is starting", "It sets off in a few seconds."],
  comingAgain: [
    "coming",
    "The car is being started again.",
    "It is driven to where it was. You can ask all the same.",
  ],
  arriving: ["coming", "The car is there", "Its first scene is on its way."],
  carGone: ["gone", "The car is not heard of any more.", "Its record is still here: you can scrub back and ask."],
  over: ["over", "The ride is over.", "Its record is still here: drag the timeline to any moment and ask about it."],
  played: [
    "over",
    "The recording is over.",
    "All of it is still here: drag the timeline to any moment and ask about it.",
  ],
  recording: ["recording", "This is a recording.", "It is played as it was driven. Ask about any moment of it."],
};

function withCode(text) {
  return text.split("`").map((part, k) => (k % 2 ? h("code", part) : part));
}

/**
 * Which state the page is in.
 * @param {import("./store.js").Store} store
 * @param {{state: string, ever: boolean, attempt: number}} connection
 * @returns {string|null} a name of STATES; null: all is well
 */
function stateOf(store, connection) {
  const { status, latest, welcome } = store;
  if (!connection.ever && connection.state === "refused") return "refused";
  if (!connection.ever) return connection.attempt > 0 ? "unreachable" : "connecting";
  if (!status.connected) return null; // the notice says it
  if (status.car === "coming") return latest ? "comingAgain" : "coming";
  if (status.hub !== "there") return status.hub === "gone" && latest ? "hubGone" : "hub";
  if (status.car === "awaited") return "car"; // also of a dashboard that was started anew
  if (!latest) return status.car === "there" ? "arriving" : "car";
  const stands = standing(store);
  if (stands === "played" || stands === "over") return stands;
  if (status.car === "gone") return "carGone";
  return welcome?.recording ? "recording" : null;
}

/**
 * @param {{card: HTMLElement, strip: HTMLElement}} elements
 * @param {import("./store.js").Store} store
 * @param {import("./connection.js").Connection} connection
 */
export function createStates({ card, strip }, store, connection) {
  let shown = "";
  let dismissed = null; // a strip that was read comes back only after another state
  const dismiss = (name) => {
    dismissed = name;
    show();
  };
  const show = () => {
    const name = stateOf(store, connection);
    const key = `${name} ${store.welcome?.vehicle} ${Boolean(store.latest)} ${dismissed === name}`;
    if (key === shown) return;
    shown = key;
    if (name !== dismissed) dismissed = null;
    const asCard = name !== null && !store.latest;
    card.hidden = !asCard;
    strip.hidden = name === null || asCard || dismissed === name;
    document.body.dataset.state = name ?? "well";
    if (strip.hidden) fill(strip);
    if (card.hidden && strip.hidden) return;
    const [picture, title, text] = STATES[name];
    const words = typeof text === "string" ? withCode(text) : text(store, connection);
    if (asCard) fill(card, h("div.state-card", { role: "status" }, drawing(picture), h("h2", title), h("p", words)));
    else fill(strip, drawing(picture), h("p", h("b", title), " ", words), hiding(() => dismiss(name)));
  };
  on(store, "status ride scene", show);
  on(connection, "state welcome", show);
  show();
}

function hiding(onclick) {
  return h("button.icon", { "aria-label": "Hide this", title: "Hide this", onclick }, "×");
}
