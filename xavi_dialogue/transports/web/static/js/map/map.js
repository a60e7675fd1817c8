/** The map: a canvas, its controls, and when they are drawn anew. */

import { h } from "../dom.js";
import { lastUpTo } from "../store.js";
import { Backdrop } from "./backdrop.js";
import { middleOf, radiusOf } from "./bodies.js";
import { createCard } from "./card.js";
import { Colours } from "./colours.js";
import { createBadge, createControls } from "./controls.js";
import { Deciding } from "./deciding.js";
import { Following } from "./following.js";
import { listen } from "./gestures.js";
import { boundsOfEvidence } from "./ghosts.js";
import { Labels } from "./labels.js";
import { createLegend } from "./legend.js";
import { boundsOf } from "./lines.js";
import { Motion, sceneAt } from "./motion.js";
import { Pace } from "./pace.js";
import { drawPicture } from "./picture.js";
import { RoadLayer, drawGrid } from "./roads.js";
import { createSummary } from "./summary.js";
import { View } from "./view.js";

const STEP = 1.5; // of the scale, by buttons and keys
const BUSY = 14; // [ms] a frame that takes longer is drawn at most 30 times a second
const SPARE = 30; // [ms]
const NEAR = 16; // [px] around a vehicle that still mean it
const NOTHING = { vehicles: [], labels: [], ghost: 0, fact: 0, predictions: 0, yields: 0, preview: false, kinds: new Set() };
const LABEL = "Map of the drive. Arrow keys move it, plus and minus zoom, 0 shows everything, F follows our car, "
  + "N and P, or the square brackets, go through the vehicles in view, Escape lets go of them.";

/**
 * Make the map.
 * @param {HTMLElement} element that it fills
 * @param {import("../store.js").Store} store
 * @returns {{fit: () => void, follow: (on?: boolean) => void, zoom: (factor: number) => void,
 *   shown: () => object, frames: () => object}}
 *   `follow` without an argument switches to and fro. `shown`: what the last frame held: {t,
 *   vehicles: ids, labels: texts, ghost, fact: numbers of lines, predictions: number of paths,
 *   yields: number of links that go first, preview, pointed, causes: ids, follow, scale [px/m]}.
 *   `frames`: {count, fps: over the last 2 s, worst_ms, draw_ms: taken by a frame, latest_scene:
 *   {seq, wall, drawn: epoch ms of the first frame on the way to it, reached: of the first frame
 *   that shows it where it is, or null}}
 */
export function createMap(element, store) {
  const map = new LiveMap(element, store);
  return {
    fit: () => map.fit(),
    follow: (on = !map.following.on) => map.follow(on),
    zoom: (factor) => map.zoom(factor),
    shown: () => map.shown(),
    frames: () => map.pace.figures(performance.now()),
  };
}

class LiveMap {
  constructor(element, store) {
    this.element = element;
    this.store = store;
    this.canvas = h("canvas", { tabindex: 0, role: "application", "aria-roledescription": "map", "aria-label": LABEL, "aria-describedby": "map-in-words" });
    this.context = this.canvas.getContext("2d", { alpha: false });
    this.view = new View();
    this.following = new Following(this.view);
    this.motion = new Motion();
    this.backdrop = new Backdrop();
    this.labels = new Labels();
    this.pace = new Pace();
    this.deciding = new Deciding(store, () => this.request());
    this.roads = null;
    this.scene = null; // that is drawn: {t, vehicles}
    this.drawn = NOTHING;
    this.hovered = null; // vehicle under the mouse
    this.chosen = null; // vehicle whose card stays
    this.compared = 0; // [ms] since when lines of a turn are shown
    this.taken = null; // rectangles under controls; null: to be measured
    this.frame = 0; // asked for
    this.began = -Infinity; // [ms] the last one
    this.build();
    this.listen();
    this.roadsCame();
    this.measure();
  }

  build() {
    this.controls = createControls({
      zoomIn: () => this.zoom(STEP),
      zoomOut: () => this.zoom(1 / STEP),
      fit: () => this.fit(),
      follow: () => this.follow(!this.following.on),
      both: () => this.showBoth(),
    });
    const moved = () => {
      this.taken = null;
      this.request();
    };
    this.legend = createLegend(moved, matchMedia("(max-width: 700px)").matches);
    this.badge = createBadge();
    this.card = createCard();
    this.summary = createSummary("map-in-words");
    this.element.classList.add("map");
    this.element.append(this.canvas, this.badge.element, this.legend.element, this.controls.bar,
      this.controls.element, this.card.element, this.summary.element, this.summary.said);
    this.colours = new Colours(this.element);
  }

  listen() {
    const on = {
      ride: () => this.begin(),
      roads: () => this.roadsCame(),
      scene: () => this.motion.arrive(this.store.latest, performance.now()),
      moment: () => this.deciding.update(),
      decisions: () => this.deciding.update(),
      shown: () => void (this.compared = performance.now()),
      pointed: () => {},
      preview: () => {},
      status: () => {},
    };
    for (const [name, change] of Object.entries(on)) {
      this.store.addEventListener(name, () => {
        change();
        this.request();
      });
    }
    const recoloured = () => {
      this.colours.read();
      this.backdrop.spoil();
      this.request();
    };
    window.addEventListener("theme", recoloured);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", recoloured);
    this.view.still.addEventListener("change", () => this.request());
    new ResizeObserver(() => this.measure()).observe(this.element);
    window.addEventListener("resize", () => this.measure()); // also when only the density changes
    this.canvas.addEventListener("focus", () => this.summary.announced(true));
    this.canvas.addEventListener("blur", () => this.summary.announced(false));
    this.touched();
  }

  touched() {
    listen(this.canvas, {
      pan: (dx, dy, pinching = false) => {
        if (!(pinching && this.following.on)) this.follow(false);
        this.view.pan(dx, dy);
        this.request();
      },
      zoom: (factor, x, y) => this.zoomAt(factor, x, y),
      zoomIn: () => this.zoom(STEP),
      zoomOut: () => this.zoom(1 / STEP),
      fit: () => this.fit(),
      follow: () => this.follow(!this.following.on),
      hover: (x, y) => this.hover(this.vehicleAt(x, y)),
      leave: () => this.hover(null),
      choose: (x, y) => this.choose(this.vehicleAt(x, y)),
      next: (step) => this.next(step),
      escape: () => (this.chosen === null ? false : this.choose(null)),
    });
  }

  begin() {
    this.motion.reset();
    this.following.reset();
    this.deciding.keep(null);
    this.chosen = null;
    this.scene = null;
    this.roadsCame();
  }

  roadsCame() {
    this.roads = this.store.roads ? new RoadLayer(this.store.roads) : null;
    this.backdrop.spoil();
  }

  measure() {
    const { clientWidth, clientHeight } = this.element;
    const first = this.view.width === 0;
    if (!clientWidth || !clientHeight || !this.view.resize(clientWidth, clientHeight, window.devicePixelRatio || 1)) return;
    this.canvas.width = Math.round(clientWidth * this.view.ratio);
    this.canvas.height = Math.round(clientHeight * this.view.ratio);
    if (first) this.view.scale = this.view.usual;
    this.taken = null;
    this.draw(performance.now()); // at once: a canvas that changed its size is empty
  }

  // --- what can be done with it ---

  follow(on) {
    this.following.set(on, this.ego);
    this.controls.following(on);
    this.request();
  }

  fit() {
    const vehicles = this.scene?.vehicles.map(({ x, y }) => [x, y]) ?? [];
    const bounds = this.roads?.bounds ?? boundsOf(vehicles, 30);
    if (!bounds) return;
    this.follow(false);
    this.view.fit(bounds, performance.now());
    this.request();
  }

  showBoth() {
    const bounds = boundsOfEvidence(this.store.evidence);
    if (!bounds) return;
    this.follow(false);
    this.view.fit(bounds, performance.now());
    this.request();
  }

  zoom(factor) {
    const { x, y } = this.view;
    const still = this.following.on && this.ego;
    this.view.glideTo(still ? null : x, still ? null : y, this.view.aim * factor, performance.now());
    this.request();
  }

  zoomAt(factor, px, py) {
    const before = this.view.scale;
    if (this.following.on && this.ego) this.view.jump({ x: null, y: null, scale: before * factor });
    else this.view.zoomAt(factor, px, py);
    this.following.zoomed(this.view.scale / before);
    this.request();
  }

  get ego() {
    return this.scene?.vehicles.find((vehicle) => vehicle.id === 0);
  }

  // --- vehicles pointed at ---

  vehicleAt(px, py) {
    let best = null;
    for (const vehicle of this.scene?.vehicles ?? []) {
      const [x, y] = this.view.toScreen(...middleOf(vehicle));
      const away = Math.hypot(x - px, y - py);
      if (away < Math.max(radiusOf(vehicle, this.view.scale), NEAR) && !(best?.away < away)) best = { id: vehicle.id, away };
    }
    return best?.id ?? null;
  }

  hover(id) {
    if (id === this.hovered) return;
    this.hovered = id;
    this.canvas.classList.toggle("map-over", id !== null);
    this.request();
  }

  choose(id) {
    const { pointed } = this.store;
    if (id === null && this.chosen !== null && pointed.size === 1 && pointed.has(this.chosen)) this.store.point([]);
    this.chosen = id;
    if (id !== null && id !== 0) this.store.point([id]);
    const vehicle = this.scene?.vehicles.find((one) => one.id === id);
    this.summary.say(vehicle, vehicle ? this.goalsOf(id) : []);
    this.request();
  }

  next(step) {
    const ids = [...this.drawn.vehicles].sort((a, b) => a - b);
    if (!ids.length) return;
    const at = ids.indexOf(this.chosen);
    const start = step > 0 ? -1 : 0;
    this.choose(ids[((at < 0 ? start : at) + step + ids.length) % ids.length]);
  }

  /** What a vehicle is expected to do: [[words, probability], ...], likeliest first. */
  goalsOf(id) {
    const beliefs = this.store.decisionAt(this.store.at)?.beliefs ?? [];
    const goals = beliefs.find((one) => one.vehicle === id)?.goals ?? [];
    return [...goals].sort((a, b) => b[1] - a[1]);
  }

  // --- drawing ---

  /** Draw a frame soon. */
  request() {
    this.frame ||= requestAnimationFrame((now) => {
      this.frame = 0;
      if (this.pace.draw > BUSY && now - this.began < SPARE) this.request();
      else this.draw(now);
    });
  }

  draw(now) {
    if (!this.view.width) return;
    const began = performance.now();
    this.began = now;
    this.scene = this.sceneNow(began);
    this.move(began);
    const settling = this.backdropNow(began);
    this.drawn = this.scene ? this.pictureNow(began) : NOTHING;
    this.around(began);
    if (this.scene && this.store.live) this.pace.painted(this.store.latest, !this.motion.moving(began));
    this.pace.frame(began, performance.now());
    if (settling || this.moving(began)) this.request();
  }

  sceneNow(now) {
    const { store } = this;
    if (!store.latest) return null;
    if (store.live) return this.motion.live(now) ?? store.latest;
    if (store.at >= store.latest.t) return store.latest;
    const index = Math.max(lastUpTo(store.past, store.at), 0);
    return sceneAt([store.past[index], store.past[index + 1] ?? store.latest], store.at);
  }

  move(now) {
    const before = this.view.scale;
    this.view.step(now);
    this.following.zoomed(this.view.scale / before);
    this.following.step(this.ego, now);
  }

  moving(now) {
    const live = this.store.live && this.motion.moving(now);
    return live || this.view.glide !== null || !this.following.settled || this.looping;
  }

  /** Whether ghosts go along their lines. */
  get looping() {
    return !this.view.still.matches && this.drawn.fact + this.drawn.ghost > 0;
  }

  backdropNow(now) {
    this.backdrop.ground = this.colours.get("ground");
    return this.backdrop.show(this.context, this.view, now, (context, bounds) => {
      this.spacing = null;
      if (this.roads) this.roads.draw(context, bounds, this.view.scale, this.colours);
      else if (this.scene) this.spacing = drawGrid(context, bounds, this.view.scale, this.colours);
    });
  }

  pictureNow(now) {
    const { store, view } = this;
    const { evidence } = store;
    const turn = store.turns.find((one) => one.n === store.turn);
    const about = (turn?.vehicles ?? []).filter((id) => id !== 0);
    this.taken ??= this.measured();
    this.labels.begin(view, this.colours.font, this.taken);
    return drawPicture({
      ...this.scene,
      detail: this.deciding.detail,
      evidence,
      preview: store.preview,
      elapsed: view.still.matches ? null : (now - this.compared) / 1000,
      causes: new Set((evidence?.causes ?? []).map((cause) => cause.vehicle)),
      pointed: new Set([...store.pointed, ...about]),
      chosen: this.chosen ?? this.hovered,
    }, { context: this.context, view, colours: this.colours, labels: this.labels, roads: this.roads });
  }

  /** What stands around and over the canvas. */
  around(now) {
    const { store, view } = this;
    this.element.dataset.car = store.status.car;
    this.element.dataset.empty = String(!this.scene);
    this.badge.update(store);
    this.legend.update(this.drawn.kinds, this.scene && !this.roads ? this.spacing : null);
    this.controls.scale(view.scale);
    const compared = this.drawn.fact + this.drawn.ghost > 0 && boundsOfEvidence(store.evidence);
    this.controls.comparing(Boolean(compared) && !view.holds(compared));
    this.cardNow();
    if (this.summary.due(now) && this.scene) this.summary.update(this.inWords(), now);
  }

  cardNow() {
    const id = this.hovered ?? this.chosen;
    const vehicle = id === null ? null : this.scene?.vehicles.find((one) => one.id === id);
    if (!vehicle) return this.card.hide();
    const [x, y] = this.view.toScreen(...middleOf(vehicle));
    const { width, height } = this.view;
    if (x < 0 || y < 0 || x > width || y > height) return this.card.hide();
    return this.card.show(vehicle, this.goalsOf(id), { x, y, reach: radiusOf(vehicle, this.view.scale), width, height });
  }

  inWords() {
    const { store } = this;
    const words = store.decisionAt(store.at)?.words ?? "";
    return { ...this.scene, live: store.live, state: store.latest.state, gone: store.status.car === "gone", roads: this.roads, words };
  }

  measured() {
    const origin = this.element.getBoundingClientRect();
    const over = [this.badge.element, this.legend.element, this.controls.element, this.controls.bar];
    return over.filter((one) => one.offsetWidth > 0).map((one) => {
      const box = one.getBoundingClientRect();
      return [box.left - origin.left, box.top - origin.top, box.right - origin.left, box.bottom - origin.top];
    });
  }

  shown() {
    const { kinds, ...drawn } = this.drawn;
    const { evidence, pointed, turns, turn } = this.store;
    return {
      t: this.scene?.t ?? null,
      ...drawn,
      pointed: [...new Set([...pointed, ...(turns.find((one) => one.n === turn)?.vehicles ?? [])])].filter((id) => id !== 0),
      causes: (evidence?.causes ?? []).map((cause) => cause.vehicle),
      follow: this.following.on,
      scale: this.view.scale,
    };
  }
}
