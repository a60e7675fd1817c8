/** The bar that says that the connection is lost, and that it is back. */
import { fill, h, say } from "./dom.js";

const BACK = 3000; // [ms] for which "Back." stands

/**
 * @param {HTMLElement} element a live region
 * @param {import("./connection.js").Connection} connection
 */
export function createNotice(element, connection) {
  let timer = null;
  const count = h("span", { "aria-hidden": "true" }); // counts by the second, which nobody wants read out
  const tick = () => {
    const left = Math.max(1, Math.ceil((connection.retryAt - performance.now()) / 1000));
    const words = connection.state === "connecting" ? " Trying again …" : ` Trying again in ${left} s.`;
    say(count, words);
  };
  const show = (kind, ...children) => {
    element.dataset.kind = kind;
    fill(element, ...children);
  };
  const lost = () => {
    const again = h("button", { type: "button", onclick: () => connection.hurry() }, "Try now");
    show("lost", h("p", {}, connection.words ?? "Connection lost.", count), again);
    tick();
    timer ??= setInterval(tick, 250);
  };
  const stop = () => {
    clearInterval(timer);
    timer = null;
  };
  connection.addEventListener("state", () => {
    if (!connection.ever && connection.words === null) return; // the page's first state says it
    if (connection.state === "refused") {
      stop();
      const again = h("button", { type: "button", onclick: () => connection.hurry() }, "Try again");
      show("lost", h("p", {}, connection.words), again);
    } else if (connection.state === "waiting") {
      lost();
    } else if (connection.state === "connecting") {
      tick();
    } else if (element.dataset.kind === "lost") {
      stop();
      show("back", h("p", {}, "Back."));
      setTimeout(() => element.dataset.kind === "back" && show("none"), BACK);
    }
  });
}
