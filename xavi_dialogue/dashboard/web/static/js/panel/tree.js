/** A tree to open and fold, by pointer and keyboard; what is folded is not in the page at all. */

import { h, set } from "../dom.js";
import { steady } from "./steady.js";

/**
 * @template T
 * @param {{label: string, row: () => HTMLElement, draw: (row: HTMLElement, item: T, open: boolean) => void,
 *   key: (item: T) => string, name: (item: T) => string, children: (item: T) => T[], open: (item: T) => boolean}} kind
 *   `row` makes what an item shows and `draw` brings it up to date; `key` is unique among siblings;
 *   `name` is what a screen reader says; `open`: whether it is open before anybody touches it
 * @returns {{element: HTMLElement, update: (items: T[]) => void}}
 */
export function createTree(kind) {
  const element = h("ul", { class: "tree", role: "tree", "aria-label": kind.label });
  const tree = { kind, element, items: [], touched: new Map() };
  element.addEventListener("keydown", (event) => typed(tree, event));
  element.addEventListener("click", (event) => clicked(tree, event));
  element.addEventListener("focusin", (event) => rove(tree, event.target.closest("[role=treeitem]")));
  return {
    element,
    update(items) {
      tree.items = items;
      render(tree);
    },
  };
}

function render(tree) {
  level(tree, tree.element, tree.items, "", 1);
  const known = tree.element.querySelector('[tabindex="0"]');
  if (!known) tree.element.firstElementChild?.setAttribute("tabindex", "0");
}

function level(tree, parent, items, above, depth) {
  const { kind } = tree;
  const make = () => h("li", { role: "treeitem", tabindex: "-1" }, kind.row());
  steady(parent, items, kind.key, make, (li, item) => {
    const path = `${above}/${kind.key(item)}`;
    const children = kind.children(item);
    const open = children.length > 0 && (tree.touched.get(path) ?? kind.open(item));
    li.dataset.path = path;
    set(li, "aria-expanded", children.length ? String(open) : null);
    set(li, "aria-level", depth);
    set(li, "aria-setsize", items.length);
    set(li, "aria-posinset", items.indexOf(item) + 1);
    set(li, "aria-label", kind.name(item));
    kind.draw(li.firstElementChild, item, open);
    branch(tree, li, open ? children : [], path, depth + 1);
  });
}

function branch(tree, li, children, path, depth) {
  let group = li.children[1];
  if (!children.length) {
    if (group?.contains(document.activeElement)) li.focus({ preventScroll: true });
    group?.remove();
    return;
  }
  if (!group) li.append((group = h("ul", { role: "group" })));
  level(tree, group, children, path, depth);
}

function rove(tree, item) {
  if (!item) return;
  for (const one of tree.element.querySelectorAll('[tabindex="0"]')) one.setAttribute("tabindex", "-1");
  item.setAttribute("tabindex", "0");
}

function fold(tree, item, open) {
  if (!item.hasAttribute("aria-expanded")) return;
  tree.touched.set(item.dataset.path, open);
  render(tree);
}

function isOpen(item) {
  return item.getAttribute("aria-expanded") === "true";
}

function clicked(tree, event) {
  const item = event.target.closest("[role=treeitem]");
  if (!item) return;
  item.focus({ preventScroll: true });
  fold(tree, item, !isOpen(item));
}

const KEYS = {
  ArrowDown: (tree, item) => step(tree, item, 1),
  ArrowUp: (tree, item) => step(tree, item, -1),
  ArrowRight: (tree, item) => (isOpen(item) ? step(tree, item, 1, item) : fold(tree, item, true)),
  ArrowLeft: (tree, item) => (isOpen(item) ? fold(tree, item, false) : parentOf(item)?.focus()),
  Home: (tree) => visible(tree)[0]?.focus(),
  End: (tree) => visible(tree).at(-1)?.focus(),
  Enter: (tree, item) => fold(tree, item, !isOpen(item)),
  " ": (tree, item) => fold(tree, item, !isOpen(item)),
  "*": (tree, item) => [...item.parentElement.children].forEach((one) => fold(tree, one, true)),
};

function typed(tree, event) {
  const item = event.target.closest("[role=treeitem]");
  if (!item || event.ctrlKey || event.altKey || event.metaKey) return;
  if (KEYS[event.key]) KEYS[event.key](tree, item);
  else if (/^\p{L}$/u.test(event.key)) seek(tree, item, event.key.toLowerCase());
  else return;
  event.preventDefault();
  event.stopPropagation();
}

function visible(tree) {
  return [...tree.element.querySelectorAll("[role=treeitem]")]; // folded ones are not there
}

function step(tree, item, by, within = tree.element) {
  const items = visible(tree);
  const next = items[items.indexOf(item) + by];
  if (next && within.contains(next)) next.focus();
}

function parentOf(item) {
  return item.parentElement.closest("[role=treeitem]");
}

/** Go to the next item whose name begins with a letter. */
function seek(tree, item, letter) {
  const items = visible(tree);
  const index = items.indexOf(item);
  const ahead = [...items.slice(index + 1), ...items.slice(0, index)];
  ahead.find((one) => one.getAttribute("aria-label").toLowerCase().startsWith(letter))?.focus();
}
