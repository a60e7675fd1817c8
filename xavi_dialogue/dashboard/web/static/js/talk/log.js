/** The turns, newest at the bottom; scrolls along only with a reader who is there. */
import { h } from "../dom.js";

const NEAR = 60; // [px] from the bottom that still count as there

/** The scrolling part of the conversation. */
export class Log {
  /** @param {...HTMLElement} below what scrolls with the turns, under them */
  constructor(...below) {
    this.turns = h("div", { class: "log", role: "log", "aria-live": "polite", "aria-label": "What was said" });
    this.scroller = h(
      "div",
      { class: "scroller", tabindex: 0, role: "group", "aria-label": "Questions and answers" },
      this.turns,
      below,
    );
    this.more = h(
      "button",
      { type: "button", class: "main more", hidden: true, onclick: () => this.toEnd() },
      "New answer ↓",
    );
    this.element = h("div", { class: "said" }, this.scroller, this.more);
    this.atEnd = true;
    this.scroller.addEventListener("scroll", () => this.scrolled(), { passive: true });
    new ResizeObserver(() => this.atEnd && this.toEnd()).observe(this.scroller);
    new ResizeObserver(() => this.scrolled()).observe(this.turns); // evidence is unfolded: that is read now
  }

  scrolled() {
    const { scrollHeight, scrollTop, clientHeight } = this.scroller;
    this.atEnd = scrollHeight - scrollTop - clientHeight < NEAR;
    if (this.atEnd) this.more.hidden = true;
    this.scroller.classList.toggle("reading", !this.atEnd);
  }

  /** Put turns in; `quietly`: they are of before, and not read out. */
  add(elements, quietly) {
    if (quietly) this.turns.setAttribute("aria-busy", "true");
    this.turns.append(...elements);
    if (quietly) requestAnimationFrame(() => this.turns.removeAttribute("aria-busy"));
    const last = elements[elements.length - 1];
    if (this.atEnd && !quietly && last) this.toTop(last);
    else if (this.atEnd) this.toEnd();
    else if (!quietly && last) this.more.hidden = false;
  }

  clear() {
    this.turns.replaceChildren();
    this.atEnd = true;
  }

  /** Something has another height. */
  settle() {
    if (this.atEnd) this.toEnd();
  }

  /** To the end, or of a long turn to its beginning, which is read first. */
  toTop(turn) {
    this.toEnd();
    if (turn.offsetHeight > this.scroller.clientHeight) this.scroller.scrollTop = turn.offsetTop;
  }

  toEnd() {
    this.scroller.scrollTop = this.scroller.scrollHeight;
    this.atEnd = true;
    this.more.hidden = true;
  }
}
