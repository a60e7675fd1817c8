/** The bar that says that the connection is lost, and that it is back. */
import { fill, h, say } from "./dom.js";

const BACK = 3000; // [ms] for which "Back." stands

/**
 * @param {HTMLElement} element a live region
 * @param {import("./connection.js").Connection} connection
 */
export function createNotice(element, connection) {
  let timer = 0;
  const count = h("span", { "aria-hidden": "true" }); // counts by the second, which nobody wants read out
  const tick = () => {
    const left = Math.max(1, Math.ceil((connection.retryAt - performance.now()) / 1000));
    say(count, connection.state === "connecting" ? " Trying again …" : ` Trying again in ${left} s.`);
  };
  const show = (kind, ...children) => {
    element.dataset.kind = kind;
    fill(element, ...children);
  };
  const lost = (words, action) =>
    show("lost", h("p", words), h("button", { onclick: () => connection.hurry() }, action));
  const states = {
    refused: () => lost(connection.words, "Try again"),
    waiting() {
      lost([connection.words ?? "Connection lost.", count], "Try now");
      tick();
      timer ||= setInterval(tick, 250);
    },
    connecting: tick,
    open() {
      if (element.dataset.kind !== "lost") return;
      show("back", h("p", "Back."));
      setTimeout(() => element.dataset.kind === "back" && show("none"), BACK);
    },
  };
  connection.addEventListener("state", () => {
    const { state } = connection;
    if (!connection.ever && connection.words === null) return; // the page's first state says it
    if (state === "refused" || state === "open") {
      clearInterval(timer);
      timer = 0;
    }
    states[state]();
  });
}
