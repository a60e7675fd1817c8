/** Tabs where there is no room for both, and the height that an on-screen keyboard leaves. */

const BOTH = "(min-width: 1700px), (min-width: 760px) and (max-width: 1099px) and (min-height: 900px)";
const IDS = ["talk", "decision"];

/**
 * @param {import("./store.js").Store} store
 * @returns {{show: (id: string) => void}}
 */
export function createLayout(store) {
  const wide = matchMedia(BOTH);
  const tabs = Object.fromEntries(IDS.map((id) => [id, document.getElementById(`tab-${id}`)]));
  let chosen = "talk";
  const apply = () => {
    document.getElementById("tabs").hidden = wide.matches;
    document.getElementById("side").classList.toggle("both", wide.matches);
    for (const id of IDS) {
      const panel = document.getElementById(id);
      const here = id === chosen;
      panel.hidden = !wide.matches && !here;
      if (wide.matches) panel.removeAttribute("role");
      else panel.setAttribute("role", "tabpanel");
      tabs[id].setAttribute("aria-selected", String(here));
      tabs[id].tabIndex = here ? 0 : -1;
    }
    if (chosen === "talk") tabs.talk.classList.remove("news");
  };
  const show = (id) => {
    chosen = id;
    apply();
    window.dispatchEvent(new Event("layout"));
  };
  for (const id of IDS) tabs[id].addEventListener("click", () => show(id));
  document.getElementById("tabs").addEventListener("keydown", (event) => turnTabs(event, chosen, tabs, show));
  wide.addEventListener("change", apply);
  announceNews(store, tabs.talk, () => !wide.matches && chosen !== "talk");
  fitKeyboard();
  apply();
  return { show };
}

function turnTabs(event, chosen, tabs, show) {
  const step = { ArrowRight: 1, ArrowLeft: -1, Home: -IDS.length, End: IDS.length }[event.key];
  if (step === undefined) return;
  event.preventDefault();
  const index = IDS.indexOf(chosen) + step;
  const wrapped =
    Math.abs(step) === 1 ? (index + IDS.length) % IDS.length : Math.min(Math.max(index, 0), IDS.length - 1);
  show(IDS[wrapped]);
  tabs[IDS[wrapped]].focus();
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
  if (!view) return;
  const fit = () => {
    if (view.scale > 1.01) return; // pinched: the reader looks closer, nothing is covered
    const covered = window.innerHeight - view.height;
    document.documentElement.style.setProperty("--height", covered > 60 ? `${view.height}px` : "");
    document.documentElement.classList.toggle("typing", typing() && view.height < 520);
    if (covered > 60) window.scrollTo(0, 0);
  };
  view.addEventListener("resize", fit);
  document.addEventListener("focusin", fit);
  document.addEventListener("focusout", () => setTimeout(fit, 50));
}

function typing() {
  return document.activeElement?.tagName === "TEXTAREA" && matchMedia("(pointer: coarse)").matches;
}
