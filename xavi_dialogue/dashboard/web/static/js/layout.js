/** Tabs where there is no room for both, and the height that an on-screen keyboard leaves. */
import { clamped } from "./figures.js";
import { set } from "./dom.js";

const BOTH = "(min-width: 1700px), (min-width: 760px) and (max-width: 1099px) and (min-height: 900px)";
const IDS = ["talk", "decision"];
const STEPS = { ArrowRight: 1, ArrowLeft: -1, Home: -Infinity, End: Infinity };

/**
 * @param {import("./store.js").Store} store
 * @returns {{show: (id: string) => void}}
 */
export function createLayout(store) {
  const wide = matchMedia(BOTH);
  const bar = document.getElementById("tabs");
  const tabs = [...bar.children];
  let chosen = "talk";
  const apply = () => {
    bar.hidden = wide.matches;
    document.getElementById("side").classList.toggle("both", wide.matches);
    IDS.forEach((id, k) => {
      const panel = document.getElementById(id);
      panel.hidden = !wide.matches && id !== chosen;
      set(panel, "role", wide.matches ? null : "tabpanel");
      set(tabs[k], "aria-selected", String(id === chosen));
      tabs[k].tabIndex = id === chosen ? 0 : -1;
    });
    if (chosen === "talk") tabs[0].classList.remove("news");
  };
  const show = (id) => {
    chosen = id;
    apply();
  };
  tabs.forEach((tab, k) => tab.addEventListener("click", () => show(IDS[k])));
  bar.addEventListener("keydown", (event) => {
    const step = STEPS[event.key];
    if (step === undefined) return;
    event.preventDefault();
    const last = IDS.length - 1;
    const index = IDS.indexOf(chosen) + step;
    const to = Number.isFinite(step) ? (index + IDS.length) % IDS.length : clamped(index, 0, last);
    show(IDS[to]);
    tabs[to].focus();
  });
  wide.addEventListener("change", apply);
  announceNews(store, tabs[0], () => !wide.matches && chosen !== "talk");
  fitKeyboard();
  apply();
  return { show };
}

/** A mark on the tab while there are answers that nobody has seen. */
function announceNews(store, tab, away) {
  let known = 0;
  store.addEventListener("turns", () => {
    if (away() && store.turns.length > known) tab.classList.add("news");
    known = store.turns.length;
  });
}

/** Some browsers lay their keyboard over the page and say so only here. */
function fitKeyboard() {
  const view = window.visualViewport;
  const root = document.documentElement;
  const fit = () => {
    if (view.scale > 1.01) return; // pinched: the reader looks closer, nothing is covered
    const covered = window.innerHeight - view.height;
    root.style.setProperty("--height", covered > 60 ? `${view.height}px` : "");
    root.classList.toggle("typing", typing() && view.height < 520);
    if (covered > 60) window.scrollTo(0, 0);
  };
  view?.addEventListener("resize", fit);
  document.addEventListener("focusin", fit);
  document.addEventListener("focusout", () => setTimeout(fit, 50));
}

function typing() {
  return document.activeElement?.tagName === "TEXTAREA" && matchMedia("(pointer: coarse)").matches;
}
