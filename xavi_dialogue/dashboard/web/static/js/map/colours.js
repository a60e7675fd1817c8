/** The colours of tokens.css and map.css as a canvas wants them, for the theme in force. */

import { h } from "../dom.js";

const TOKENS = [
  "card",
  "edge",
  "ink",
  "ink-soft",
  "accent",
  "accent-ink",
  "foil",
  "cause",
  "other",
  "bad",
  "warn",
  "ground",
  "road",
  "road-junction",
  "marking",
  "focus",
  "map-glass",
  "map-brake",
  "map-indicator",
  "map-kerb",
  "map-grid",
  "map-red",
  "map-amber",
  "map-green",
  "map-lamp-sign",
  "map-hidden",
  "map-person",
  "map-pavement",
  "map-cycleway",
  "map-rails",
];
const PAINTS = ["white", "grey", "black", "red", "orange", "yellow", "green", "blue", "purple", "brown"];

const PAINTED = new Map(PAINTS.map((paint) => [paint, `paint-${paint}`]));

export class Colours {
  /** @param {Element} element that is of the theme; gets a hidden child that colours are read from */
  constructor(element) {
    this.probe = h("span", { class: "map-probe", "aria-hidden": "true" });
    element.append(this.probe);
    this.read();
  }

  /** Read all colours anew. */
  read() {
    this.rgb = new Map();
    this.made = new Map();
    for (const name of TOKENS) this.rgb.set(name, this.resolved(`--${name}`));
    for (const name of PAINTS) this.rgb.set(`paint-${name}`, this.resolved(`--map-paint-${name}`));
    this.font = getComputedStyle(this.probe).fontFamily;
  }

  // A custom property's own value would still be `light-dark(...)`: only a real one is resolved.
  resolved(token) {
    this.probe.style.color = `var(${token})`;
    const numbers = getComputedStyle(this.probe).color.match(/[\d.]+/g) ?? ["0", "0", "0"];
    return numbers.slice(0, 3).map(Number);
  }

  /** A colour with an opacity, 0 to 1. */
  get(name, alpha = 1) {
    let shades = this.made.get(name);
    if (!shades) this.made.set(name, (shades = new Map()));
    const part = Math.round(alpha * 100);
    let made = shades.get(part);
    if (!made) {
      const [r, g, b] = this.rgb.get(name);
      made = `rgba(${r}, ${g}, ${b}, ${part / 100})`;
      shades.set(part, made);
    }
    return made;
  }

  /** The name of the colour that a vehicle is painted in. */
  paintOf(vehicle) {
    if (vehicle.id === 0) return "accent";
    return PAINTED.get(vehicle.colour) ?? "other";
  }
}
