/** The turns, newest at the bottom; scrolls along only with a reader who is there. */

const NEAR = 60; // [px] from the bottom that still count as there

/** The scrolling part of the conversation. */
export class Log {
  atEnd = true;

  /** @param {{turns: HTMLElement, scroller: HTMLElement, more: HTMLElement}} parts */
  constructor({ turns, scroller, more }) {
    Object.assign(this, { turns, scroller, more });
    more.addEventListener("click", () => this.toEnd());
    scroller.addEventListener("scroll", () => this.scrolled(), { passive: true });
    new ResizeObserver(() => this.settle()).observe(scroller);
    new ResizeObserver(() => this.scrolled()).observe(turns); // evidence is unfolded: that is read now
  }

  scrolled() {
    const { scrollHeight, scrollTop, clientHeight } = this.scroller;
    this.atEnd = scrollHeight - scrollTop - clientHeight < NEAR;
    if (this.atEnd) this.more.hidden = true;
    this.scroller.classList.toggle("reading", !this.atEnd);
  }

  /** Put turns in; `quietly`: they are of before, and not read out. */
  add(elements, quietly) {
    if (quietly) this.turns.ariaBusy = "true";
    this.turns.append(...elements);
    if (quietly) requestAnimationFrame(() => (this.turns.ariaBusy = null));
    const last = elements.at(-1);
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
