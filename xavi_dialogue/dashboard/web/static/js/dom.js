/** Elements made in one go; text is always text, never markup. */

const SVG = "http://www.w3.org/2000/svg";
const DRAWN = new Set(["svg", "g", "path", "line", "rect", "circle", "text"]);

/**
 * Make an element.
 * @param {string} kind name and classes: "p.quiet.small"; names of SVG as well
 * @param {...any} parts attributes in an object (`on…` handlers, `dataset`; null, undefined and false
 *   leave one out, true gives it no value), or children: nodes, texts, or lists of them
 * @returns {any}
 */
export function h(kind, ...parts) {
  const [name, ...classes] = kind.split(".");
  const element = DRAWN.has(name) ? document.createElementNS(SVG, name) : document.createElement(name);
  if (classes.length) element.setAttribute("class", classes.join(" "));
  if (name === "button") element.type = "button";
  for (const part of parts) {
    if (part?.constructor === Object) setAll(element, part);
    else add(element, part);
  }
  return element;
}

/** Set many attributes: see `h`. */
export function setAll(element, attributes) {
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith("on")) element.addEventListener(key.slice(2), value);
    else if (key === "dataset") Object.assign(element.dataset, value);
    else set(element, key, value === true ? "" : value);
  }
}

/** Replace all that an element holds. */
export function fill(element, ...children) {
  element.replaceChildren();
  add(element, children);
}

function add(element, child) {
  if (child === null || child === undefined || child === false) return;
  if (Array.isArray(child)) child.forEach((one) => add(element, one));
  else element.append(child);
}

/** Set text only where it is another one, so that a selection of the reader stays. */
export function say(element, text) {
  const words = String(text ?? "");
  if (element.textContent !== words) element.textContent = words;
}

/** Set an attribute only where it changes; null and false take it away. */
export function set(element, name, value) {
  if (value === null || value === undefined || value === false) element.removeAttribute(name);
  else if (element.getAttribute(name) !== String(value)) element.setAttribute(name, String(value));
}

/** A small drawing in the colour of the text around it. */
export function icon(d, viewBox = "0 0 24 24") {
  return h("svg", { viewBox, "aria-hidden": "true" }, h("path", { d }));
}

/** By name, the parts of an element that are marked `data-part`. */
export function partsOf(element) {
  return Object.fromEntries([...element.querySelectorAll("[data-part]")].map((one) => [one.dataset.part, one]));
}

/** A copy of a template of index.html. */
export function copyOf(id) {
  return document.getElementById(id).content.firstElementChild.cloneNode(true);
}

/** One of the drawings for what is not there. */
export function drawing(name) {
  return document.getElementById("drawings").content.querySelector(`[data-name=${name}]`).cloneNode(true);
}

/** Grey lines where something is on its way; `words` are for those who hear the page. */
export function awaited(words, lines = 3) {
  const grey = Array.from({ length: lines }, () => h("span.awaited-line", { "aria-hidden": "true" }));
  return h("div.awaited", { role: "status" }, h("span.unseen", words), grey);
}

/** Listen to several events, given in one text. */
export function on(target, names, listener) {
  for (const name of names.split(" ")) target.addEventListener(name, listener);
}

/** Call `near` while the mouse is over an element or the keyboard is on its button, and `away` after. */
export function pointedAt(element, button, near, away) {
  element.addEventListener("pointerenter", (event) => event.pointerType === "mouse" && near());
  element.addEventListener("pointerleave", (event) => event.pointerType === "mouse" && away());
  button.addEventListener("focus", () => button.matches(":focus-visible") && near());
  button.addEventListener("blur", away);
}

/** A function that runs `work` once in the coming frame, however often it is called. */
export function eachFrame(work) {
  let asked = 0;
  return () => {
    asked ||= requestAnimationFrame(() => {
      asked = 0;
      work();
    });
  };
}
