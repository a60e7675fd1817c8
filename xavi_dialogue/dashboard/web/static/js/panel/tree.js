/** A tree to open and fold, by pointer and keyboard; what is folded is not in the page at all. */

import { h, set, setAll } from "../dom.js";
import { steady } from "./steady.js";

const ITEM = "[role=treeitem]";

/**
 * @template T
 * @param {HTMLElement} element of the tree
 * @param {{row: () => HTMLElement, draw: (row: HTMLElement, item: T, open: boolean) => void,
 *   key: (item: T) => string, name: (item: T) => string, children: (item: T) => T[], open: (item: T) => boolean}} kind
 *   `row` makes what an item shows and `draw` brings it up to date; `key` is unique among siblings;
 *   `name` is what a screen reader says; `open`: whether it is open before anybody touches it
 * @returns {{update: (items: T[]) => void}}
 */
export function createTree(element, kind) {
  const tree = new Tree(element, kind);
  return { update: (items) => tree.render(items) };
}

class Tree {
  items = [];
  touched = new Map(); // whether items that somebody touched are open, by path

  constructor(element, kind) {
    Object.assign(this, { element, kind });
    element.addEventListener("keydown", (event) => this.type(event));
    element.addEventListener("click", (event) => this.click(event));
    element.addEventListener("focusin", (event) => this.rove(event.target.closest(ITEM)));
  }

  render(items = this.items) {
    this.items = items;
    this.level(this.element, items, "", 1);
    if (!this.element.querySelector('[tabindex="0"]')) this.element.firstElementChild?.setAttribute("tabindex", "0");
  }

  level(parent, items, above, depth) {
    const { kind } = this;
    const make = () => h("li", { role: "treeitem", tabindex: "-1" }, kind.row());
    steady(parent, items, kind.key, make, (li, item) => {
      const path = `${above}/${kind.key(item)}`;
      const children = kind.children(item);
      const open = children.length > 0 && (this.touched.get(path) ?? kind.open(item));
      setAll(li, {
        "data-path": path,
        "aria-expanded": children.length ? String(open) : null,
        "aria-level": depth,
        "aria-setsize": items.length,
        "aria-posinset": items.indexOf(item) + 1,
        "aria-label": kind.name(item),
      });
      kind.draw(li.firstElementChild, item, open);
      this.branch(li, open ? children : [], path, depth + 1);
    });
  }

  branch(li, children, path, depth) {
    let group = li.children[1];
    if (!children.length) {
      if (group?.contains(document.activeElement)) li.focus({ preventScroll: true });
      group?.remove();
      return;
    }
    if (!group) li.append((group = h("ul", { role: "group" })));
    this.level(group, children, path, depth);
  }

  /** Let the keyboard come to an item, and no other one, by Tab. */
  rove(item) {
    if (!item) return;
    for (const one of this.element.querySelectorAll('[tabindex="0"]')) set(one, "tabindex", "-1");
    set(item, "tabindex", "0");
  }

  fold(item, open = !isOpen(item)) {
    if (!item.hasAttribute("aria-expanded")) return;
    this.touched.set(item.dataset.path, open);
    this.render();
  }

  click(event) {
    const item = event.target.closest(ITEM);
    if (!item) return;
    item.focus({ preventScroll: true });
    this.fold(item);
  }

  type(event) {
    const item = event.target.closest(ITEM);
    if (!item || event.ctrlKey || event.altKey || event.metaKey) return;
    if (KEYS[event.key]) KEYS[event.key](this, item);
    else if (/^\p{L}$/u.test(event.key)) this.seek(item, event.key.toLowerCase());
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  /** Items that are in the page: folded ones are not. */
  get visible() {
    return [...this.element.querySelectorAll(ITEM)];
  }

  step(item, by, within = this.element) {
    const items = this.visible;
    const next = items[items.indexOf(item) + by];
    if (next && within.contains(next)) next.focus();
  }

  /** Go to the next item whose name begins with a letter. */
  seek(item, letter) {
    const items = this.visible;
    const index = items.indexOf(item);
    const ahead = [...items.slice(index + 1), ...items.slice(0, index)];
    ahead.find((one) => one.ariaLabel.toLowerCase().startsWith(letter))?.focus();
  }
}

const KEYS = {
  ArrowDown: (tree, item) => tree.step(item, 1),
  ArrowUp: (tree, item) => tree.step(item, -1),
  ArrowRight: (tree, item) => (isOpen(item) ? tree.step(item, 1, item) : tree.fold(item, true)),
  ArrowLeft: (tree, item) => (isOpen(item) ? tree.fold(item, false) : item.parentElement.closest(ITEM)?.focus()),
  Home: (tree) => tree.visible[0]?.focus(),
  End: (tree) => tree.visible.at(-1)?.focus(),
  Enter: (tree, item) => tree.fold(item),
  " ": (tree, item) => tree.fold(item),
  "*": (tree, item) => [...item.parentElement.children].forEach((one) => tree.fold(one, true)),
};

function isOpen(item) {
  return item.getAttribute("aria-expanded") === "true";
}
