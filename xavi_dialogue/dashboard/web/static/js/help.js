/** The dialog that tells the keys. */
import { fill, h } from "./dom.js";
import { recall, remember } from "./remembered.js";

const KEY = "xavi-keys";
const ROWS = [
  ["/", "type a question"],
  ["Enter", "ask; Shift and Enter begins another line"],
  ["↑ ↓", "in an empty question: those that you asked before"],
  ["Esc", "give up the answer that you wait for"],
  ["L", "back to live, or to the end"],
  ["T", "to the timeline: arrows move by 0.2 s, Page Up and Page Down by decisions"],
  ["D", "to the decision"],
  ["M", "to the map: arrows move it, N and P go through the vehicles"],
  ["+ −", "on the map: closer, farther"],
  ["F", "let the map follow the car"],
  ["0", "show all of the map"],
  ["?", "this help"],
];

const INTRODUCTION =
  "Ask the car why it did something, what it does now, what others will do, or what would have happened otherwise. " +
  "Drag the timeline to an earlier moment to ask about that. Nothing here steers the car.";

/**
 * @param {HTMLDialogElement} dialog
 * @returns {{open: () => void, singleKeys: () => boolean}}
 */
export function createHelp(dialog) {
  const box = h("input", { type: "checkbox", id: "single-keys" });
  box.checked = recall(KEY) !== "off";
  box.addEventListener("change", () => remember(KEY, box.checked ? null : "off"));
  const rows = ROWS.map(([keys, does]) =>
    h(
      "div",
      {},
      h(
        "dt",
        {},
        keys.split(" ").map((key) => h("kbd", {}, key)),
      ),
      h("dd", {}, does),
    ),
  );
  fill(
    dialog,
    h("h2", { id: "help-title" }, "What can be done here"),
    h("p", {}, INTRODUCTION),
    h("h3", {}, "Keys"),
    h("dl", { class: "keys" }, rows),
    h("label", { class: "check" }, box, "Single letters are shortcuts"),
    h("button", { type: "button", class: "main", autofocus: true, onclick: () => dialog.close() }, "Close"),
  );
  dialog.addEventListener("click", (event) => event.target === dialog && dialog.close()); // beside it
  return { open: () => dialog.open || dialog.showModal(), singleKeys: () => box.checked };
}
