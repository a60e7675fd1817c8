/** Where the reader has scrolled to stays in sight, whatever above it grows, shrinks or moves. */

const KINDS = ["summary", "[role=treeitem] > .branch", "tr[data-action]", ".other"]; // the steadiest first

/**
 * Change what is in a scrolled element, and keep what the reader looks at where it is: what has the
 * focus or the pointer, else what is in view.
 * @param {HTMLElement} scroller
 * @param {() => void} work
 */
export function staying(scroller, work) {
  if (scroller.scrollTop <= 0) return work();
  const anchors = candidates(scroller).map((element) => [element, element.getBoundingClientRect().top]);
  work();
  const kept = anchors.find(([element]) => scroller.contains(element) && element.offsetParent !== null);
  if (!kept) return undefined;
  const moved = kept[0].getBoundingClientRect().top - kept[1];
  if (Math.abs(moved) >= 1) scroller.scrollTop += moved;
  return undefined;
}

function candidates(scroller) {
  const { top, bottom } = scroller.getBoundingClientRect();
  const inView = (element) => {
    const box = element.getBoundingClientRect();
    return box.top >= top && box.top < bottom - 20;
  };
  const all = KINDS.flatMap((kind) => [...scroller.querySelectorAll(kind)]).filter(inView);
  const focused = document.activeElement;
  const held = all.filter((element) => element.contains(focused) || focused?.firstElementChild === element);
  return [...held, ...all.filter((element) => element.matches(":hover")), ...all];
}
