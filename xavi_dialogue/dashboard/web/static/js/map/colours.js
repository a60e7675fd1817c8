/** The colours of tokens.css and map.css as a canvas wants them, for the theme in force. */

const PAINTS = new Set(
  ["white", "grey", "black", "red", "orange", "yellow", "green", "blue", "purple", "brown"], // see map.css
);

export class Colours {
  /** @param {Element} probe a hidden element of the theme, which colours are read from */
  constructor(probe) {
    this.probe = probe;
    this.forget();
  }

  /** Read all colours anew. */
  forget() {
    this.rgb = new Map(); // by name
    this.made = new Map(); // by name, then by opacity
    this.font = getComputedStyle(this.probe).fontFamily;
  }

  // A custom property's own value would still be `light-dark(...)`: only a real one is resolved.
  resolved(name) {
    this.probe.style.color = `var(--${name})`;
    const numbers = getComputedStyle(this.probe).color.match(/[\d.]+/g) ?? ["0", "0", "0"];
    return numbers.slice(0, 3).join(", ");
  }

  /** The colour of a token, with an opacity, 0 to 1. */
  get(name, alpha = 1) {
    if (!this.made.has(name)) {
      this.made.set(name, new Map());
      this.rgb.set(name, this.resolved(name));
    }
    const shades = this.made.get(name);
    const part = Math.round(alpha * 100);
    if (!shades.has(part)) shades.set(part, `rgba(${this.rgb.get(name)}, ${part / 100})`);
    return shades.get(part);
  }

  /** The name of the colour that a vehicle is painted in. */
  paintOf({ id, colour }) {
    if (id === 0) return "accent";
    return PAINTS.has(colour) ? `map-paint-${colour}` : "other";
  }
}
