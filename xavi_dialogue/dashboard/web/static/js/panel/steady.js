/**
 * Lists that change without being made anew: what is still there keeps its element, and with it
 * focus, what is folded open, and where it is scrolled to.
 */

const KEY = Symbol("key");

/**
 * Make the children of an element those of `items`, in their order.
 * @template T
 * @param {Element} parent holds nothing else
 * @param {T[]} items
 * @param {(item: T) => string|number} key names an item; of two of the same name the first counts
 * @param {(item: T) => Element} make the element of a new item
 * @param {(element: any, item: T) => void} update brings it up to date; also after `make`
 */
export function steady(parent, items, key, make, update) {
  const known = new Map([...parent.children].map((child) => [child[KEY], child]));
  const focused = parent.contains(document.activeElement) ? document.activeElement : null;
  const wanted = new Map();
  for (const item of items) {
    const name = key(item);
    if (wanted.has(name)) continue;
    const element = known.get(name) ?? make(item);
    element[KEY] = name;
    wanted.set(name, element);
    update(element, item);
  }
  for (const [name, child] of known) if (wanted.get(name) !== child) child.remove();
  let place = parent.firstElementChild;
  for (const element of wanted.values()) {
    if (element === place) place = place.nextElementSibling;
    else parent.insertBefore(element, place); // only what is out of order moves
  }
  if (!focused || document.activeElement === focused) return;
  const next = focused.isConnected ? focused : refuge(parent);
  next?.focus({ preventScroll: true });
}

/** Where the focus goes when what had it is gone: as near as can be, never to the page's top. */
function refuge(parent) {
  const around = parent.closest("[role=treeitem]") ?? parent.querySelector("[role=treeitem], button");
  return around ?? parent.closest("details")?.querySelector("summary");
}
