/** Single keys, for those who do without a pointer; never while somebody types. */

/**
 * @param {{store: any, map: any, talk: any, help: any, layout: any}} parts
 */
export function listenToKeys({ store, map, talk, help, layout }) {
  const does = {
    "/": () => {
      layout.show("talk");
      talk?.focus();
    },
    "?": () => help.open(),
    l: () => store.goLive(),
    f: () => map?.follow(true),
    0: () => map?.fit(),
    m: () => document.querySelector("#map canvas")?.focus(),
    t: () => document.querySelector("#timeline [role=slider]")?.focus(),
    d: () => {
      layout.show("decision");
      document.getElementById("decision").focus();
    },
  };
  document.addEventListener("keydown", (event) => {
    if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey) return;
    if (!help.singleKeys() || typesIn(event.target) || document.querySelector("dialog[open]")) return;
    const act = does[event.key.toLowerCase()];
    if (!act) return;
    event.preventDefault();
    act();
  });
}

function typesIn(element) {
  return element instanceof Element && element.closest("input, textarea, select, [contenteditable]") !== null;
}
