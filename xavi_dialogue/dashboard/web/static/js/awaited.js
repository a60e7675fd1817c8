/** Grey lines where something is on its way. */
import { h } from "./dom.js";

/** @param {string} words for those who hear the page @param {number} lines */
export function createAwaited(words, lines = 3) {
  const grey = Array.from({ length: lines }, () => h("span", { class: "awaited-line", "aria-hidden": "true" }));
  return h("div", { class: "awaited", role: "status" }, h("span", { class: "unseen" }, words), grey);
}
