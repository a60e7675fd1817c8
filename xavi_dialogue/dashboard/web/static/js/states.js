/** What the whole page says where something is not there: a card over the empty map, or a strip above it. */
import { fill, h } from "./dom.js";
import { draw } from "./drawings.js";
import { standing } from "./standing.js";

const code = (text) => h("code", {}, text);

/** By name: drawing, headline, what it means, and whether there is still anything that works. */
const STATES = {
  connecting: { drawing: "connecting", title: "Connecting …", says: () => ["to the dashboard on this address."] },
  unreachable: {
    drawing: "unreachable",
    title: "The dashboard does not answer",
    says: () => [
      "It may have been stopped. Start it with ",
      code("xavi dashboard"),
      "; this page goes on trying and needs no reload.",
    ],
  },
  refused: {
    drawing: "unreachable",
    title: "Not let in",
    says: (_, connection) => [connection.words],
  },
  hub: {
    drawing: "hub",
    title: "Waiting for the hub",
    says: () => [
      "Car, service and this page meet at a hub, and it is not there yet. A service brings one: ",
      code("xavi serve"),
      ". This page goes on by itself.",
    ],
  },
  hubGone: {
    drawing: "hub",
    title: "The hub is gone.",
    says: () => ["Nothing new is heard. What was seen is still here: you can scrub back and look at every decision."],
  },
  car: {
    drawing: "car",
    title: "Waiting for the car",
    says: ({ welcome }) => [
      "Nobody by the name of ",
      h("b", {}, welcome?.vehicle ?? "car"),
      " drives yet. Start one with ",
      code("xavi drive --connect …"),
      ", or ",
      code("xavi dashboard --scenario s1"),
      " to have all in one.",
    ],
  },
  coming: { drawing: "coming", title: "The car is starting", says: () => ["It sets off in a few seconds."] },
  comingAgain: {
    drawing: "coming",
    title: "The car is being started again.",
    says: () => ["It is driven to where it was. You can ask all the same."],
  },
  arriving: { drawing: "coming", title: "The car is there", says: () => ["Its first scene is on its way."] },
  carGone: {
    drawing: "gone",
    title: "The car is not heard of any more.",
    says: () => ["Its record is still here: you can scrub back and ask."],
  },
  over: {
    drawing: "over",
    title: "The ride is over.",
    says: () => ["Its record is still here: drag the timeline to any moment and ask about it."],
  },
  played: {
    drawing: "over",
    title: "The recording is over.",
    says: () => ["All of it is still here: drag the timeline to any moment and ask about it."],
  },
  recording: {
    drawing: "recording",
    title: "This is a recording.",
    says: () => ["It is played as it was driven. Ask about any moment of it."],
  },
};

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
    if (asCard) showCard(card, STATES[name], store, connection);
    else if (!strip.hidden) showStrip(strip, STATES[name], store, () => ((dismissed = name), show()));
    else fill(strip);
  };
  for (const event of ["status", "ride", "scene"]) store.addEventListener(event, show);
  for (const event of ["state", "welcome"]) connection.addEventListener(event, show);
  show();
}

function showCard(card, { drawing, title, says }, store, connection) {
  const words = [h("h2", {}, title), h("p", {}, says(store, connection))];
  fill(card, h("div", { class: "state-card", role: "status" }, draw(drawing), words));
}

function showStrip(strip, { drawing, title, says }, store, dismiss) {
  const close = h(
    "button",
    { type: "button", class: "icon", "aria-label": "Hide this", title: "Hide this", onclick: dismiss },
    "×",
  );
  fill(strip, draw(drawing), h("p", {}, h("b", {}, title), " ", says(store)), close);
}
