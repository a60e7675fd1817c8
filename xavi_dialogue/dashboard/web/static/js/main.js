/** Puts the page together. */
import { createBar } from "./bar.js";
import { Connection } from "./connection.js";
import { fill, h } from "./dom.js";
import { fetchJson } from "./fetching.js";
import { createHelp } from "./help.js";
import { listenToKeys } from "./keys.js";
import { createLayout } from "./layout.js";
import { createNotice } from "./notice.js";
import { createStates } from "./states.js";
import { Store } from "./store.js";

const byId = (id) => document.getElementById(id);

/** Load one part of the page; where that fails, the others work all the same. */
async function part(id, path, make) {
  try {
    return make(await import(path), byId(id));
  } catch (error) {
    console.error(error);
    const again = h("button.quiet", { onclick: () => location.reload() }, "Load the page again");
    fill(byId(id), h("p.broken", { role: "alert" }, "This part of the page could not be loaded. ", again));
    return null;
  }
}

async function start() {
  const store = new Store(fetchJson);
  const connection = new Connection(store, `${location.origin.replace("http", "ws")}/ws`);
  const help = createHelp(byId("help"));
  createBar(byId("bar"), store, help);
  createNotice(byId("notice"), connection);
  createStates({ card: byId("state"), strip: byId("strip") }, store, connection);
  const layout = createLayout(store);
  const [map, timeline, decision, talk] = await Promise.all([
    part("map", "./map/map.js", (module, element) => module.createMap(element, store)),
    part("timeline", "./panel/timeline.js", (module, element) => module.createTimeline(element, store)),
    part("decision", "./panel/decision.js", (module, element) => module.createDecision(element, store)),
    part("talk", "./talk/conversation.js", (module, element) => module.createConversation(element, store, connection)),
  ]);
  listenToKeys({ store, map, talk, help, layout });
  window.xavi = { store, map, connection, timeline, decision, talk };
  connection.open();
}

start();
