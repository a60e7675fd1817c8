/** Light, dark, or as the system has it. */
import { fill, h } from "./dom.js";
import { recall, remember } from "./remembered.js";

const KEY = "xavi-theme";
const THEMES = ["system", "light", "dark"];
const ICONS = {
  system: "M4 5h16v10H4zM9 19h6M12 15v4",
  light:
    "M12 8a4 4 0 1 0 0 8 4 4 0 0 0 0-8zM12 2v2m0 16v2M2 12h2m16 0h2M5 5l1.4 1.4M17.6 17.6 19 19M5 19l1.4-1.4M17.6 6.4 19 5",
  dark: "M20 14.5A8.5 8.5 0 0 1 9.5 4a8.5 8.5 0 1 0 10.5 10.5z",
};

/**
 * The button that changes the theme. Tells window by an event `theme`.
 * @returns {HTMLElement}
 */
export function createThemeSwitch() {
  let theme = THEMES.includes(recall(KEY)) ? recall(KEY) : "system";
  const button = h("button", { type: "button", class: "icon", id: "theme", onclick: () => choose(following(theme)) });
  const show = () => {
    const label = `Theme: ${theme}. Change to ${following(theme)}`;
    button.setAttribute("aria-label", label);
    button.title = label;
    const icon = h("svg", { viewBox: "0 0 24 24", "aria-hidden": "true" }, h("path", { d: ICONS[theme] }));
    fill(button, icon);
  };
  const choose = (next) => {
    theme = next;
    remember(KEY, theme === "system" ? null : theme);
    if (theme === "system") delete document.documentElement.dataset.theme;
    else document.documentElement.dataset.theme = theme;
    show();
    window.dispatchEvent(new Event("theme"));
  };
  show();
  return button;
}

function following(theme) {
  return THEMES[(THEMES.indexOf(theme) + 1) % THEMES.length];
}
