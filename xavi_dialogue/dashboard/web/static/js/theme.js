/** Light, dark, or as the system has it. */
import { fill, icon } from "./dom.js";
import { recall, remember } from "./remembered.js";

const KEY = "xavi-theme";
const ICONS = {
  system: "M4 5h16v10H4zM9 19h6M12 15v4",
  light:
    "M12 8a4 4 0 1 0 0 8 4 4 0 0 0 0-8zM12 2v2m0 16v2M2 12h2m16 0h2" +
    "M5 5l1.4 1.4M17.6 17.6 19 19M5 19l1.4-1.4M17.6 6.4 19 5",
  dark: "M20 14.5A8.5 8.5 0 0 1 9.5 4a8.5 8.5 0 1 0 10.5 10.5z",
};
const THEMES = Object.keys(ICONS);

/** Let a button change the theme, and tell the window by an event `theme`. */
export function followTheme(button) {
  let theme = THEMES.includes(recall(KEY)) ? recall(KEY) : "system";
  const next = () => THEMES[(THEMES.indexOf(theme) + 1) % THEMES.length];
  const show = () => {
    button.title = button.ariaLabel = `Theme: ${theme}. Change to ${next()}`;
    fill(button, icon(ICONS[theme]));
  };
  button.addEventListener("click", () => {
    theme = next();
    remember(KEY, theme === "system" ? null : theme);
    if (theme === "system") delete document.documentElement.dataset.theme;
    else document.documentElement.dataset.theme = theme;
    show();
    window.dispatchEvent(new Event("theme"));
  });
  show();
}
