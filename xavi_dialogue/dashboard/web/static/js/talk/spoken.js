/** Vehicles named in a text become buttons that point at them on the map. */
import { h, on } from "../dom.js";
import { nameOf } from "../words.js";

const NAMED = /\b(vehicle\s+)(\d+)\b|\b(vehicles\s+)(\d+(?:(?:,\s*(?:and\s+|or\s+)?|\s+(?:and|or)\s+)\d+)*)\b/gi;

/**
 * Cut a text where it names vehicles.
 * @param {string} text
 * @param {Set<number>} vehicles that may be meant
 * @returns {Array<string|{vehicle: number, words: string}>}
 */
function cut(text, vehicles) {
  const parts = [];
  let done = 0;
  const name = (from, to, number) => {
    if (!vehicles.has(Number(number))) return;
    parts.push(text.slice(done, from), { vehicle: Number(number), words: text.slice(from, to) });
    done = to;
  };
  for (const match of text.matchAll(NAMED)) {
    if (match[2] !== undefined) {
      name(match.index, match.index + match[0].length, match[2]);
      continue;
    }
    const start = match.index + match[3].length;
    for (const one of match[4].matchAll(/\d+/g)) name(start + one.index, start + one.index + one[0].length, one[0]);
  }
  parts.push(text.slice(done));
  return parts.filter((part) => part !== "");
}

/** Texts and buttons that name vehicles, in one part of the page. */
export class Spoken {
  /**
   * @param {import("../pointing.js").Pointing} pointing
   * @param {HTMLElement} root of all buttons
   */
  constructor(pointing, root) {
    Object.assign(this, { pointing, root });
    pointing.addEventListener("change", () => this.follow());
  }

  /** The text with its vehicles as buttons; brackets and stops stay on the line of their vehicle. */
  text(text, vehicles) {
    const said = [];
    let before = ""; // what is left of the text so far
    for (const part of cut(text, new Set(vehicles))) {
      if (typeof part === "string") {
        const after = said.length > 0 ? part.match(/^[^\s\w]*/)[0] : "";
        said.at(-1)?.append(after);
        before = part.slice(after.length);
        continue;
      }
      const opening = before.match(/[^\s\w]*$/)[0];
      said.push(document.createTextNode(before.slice(0, before.length - opening.length)));
      said.push(h("span.together", opening, this.button(part.vehicle, part.words)));
      before = "";
    }
    return [...said, before];
  }

  button(vehicle, words) {
    const { pointing } = this;
    const near = () => pointing.near(vehicle);
    const away = () => pointing.away();
    const attributes = {
      dataset: { vehicle },
      "aria-label": /^\d+$/.test(words) ? nameOf(vehicle) : null,
      "aria-pressed": String(pointing.kept.has(vehicle)),
      title: "Show it on the map",
      onclick: () => pointing.toggle(vehicle),
    };
    const button = h("button.named", attributes, words);
    on(button, "pointerenter focus", near);
    on(button, "pointerleave blur", away);
    return button;
  }

  follow() {
    for (const button of this.root.querySelectorAll("button.named")) {
      button.ariaPressed = String(this.pointing.kept.has(Number(button.dataset.vehicle)));
    }
  }
}
