/** The map: a canvas, its controls, and when they are drawn anew. */

import { on, partsOf } from "../dom.js";
import { lastUpTo } from "../store.js";
import { Around } from "./around.js";
import { Backdrop } from "./backdrop.js";
import { Sprites } from "./bitmaps.js";
import { Choosing, toldOf } from "./choosing.js";
import { Colours } from "./colours.js";
import { Deciding } from "./deciding.js";
import { Following } from "./following.js";
import { Framing, pointsThatMatter } from "./framing.js";
import { listen } from "./gestures.js";
import { boundsOfEvidence } from "./ghosts.js";
import { Labels } from "./labels.js";
import { boundsOf } from "./lines.js";
import { Motion, sceneAt } from "./motion.js";
import { Pace } from "./pace.js";
import { drawPicture } from "./picture.js";
import { RoadLayer, drawGrid } from "./roads.js";
import { Steering } from "./steering.js";
import { Surface } from "./surface.js";
import { View } from "./view.js";

const BUSY = 14; // [ms] a frame that takes longer is drawn at most 30 times a second
const SPARE = 30; // [ms]
const NONE = { ghost: 0, fact: 0, predictions: 0, yields: 0, lights: 0, imagined: 0, hidden: false, preview: false };
const NOTHING = { ...NONE, vehicles: [], labels: [], kinds: new Set() };

/**
 * Make the map.
 * @param {HTMLElement} element that it fills
 * @param {import("../store.js").Store} store
 * @returns {{fit: () => void, follow: (on?: boolean) => void, zoom: (factor: number) => void,
 *   shown: () => object, frames: () => object}}
 *   `follow` without an argument switches to and fro. `shown`: what the last frame held: {t,
 *   vehicles: ids, labels: texts, ghost, fact: numbers of lines, predictions: number of paths,
 *   yields: number of links that go first, lights: number of lamps, hidden: whether parts of the
 *   road are, imagined: number of those who may come from there, preview, pointed, causes: ids, follow, scale [px/m]}.
 *   `frames`: {count, fps: over the last 2 s, worst_ms, draw_ms: taken by a frame, latest_scene:
 *   {seq, wall, drawn: epoch ms of the first frame on the way to it}, reached_scene: likewise the
 *   latest that vehicles have come to where it says}
 */
export function createMap(element, store) {
  const map = new LiveMap(element, store);
  return {
    fit: () => map.fit(),
    follow: (on) => map.steering.follow(on),
    zoom: (factor) => map.steering.zoom(factor),
    shown: () => map.shown(),
    frames: () => map.pace.figures(performance.now()),
  };
}

class LiveMap {
  view = new View();
  motion = new Motion();
  backdrop = new Backdrop();
  labels = new Labels();
  sprites = new Sprites();
  pace = new Pace();
  roads = null;
  scene = null; // that is drawn: {t, vehicles}
  drawn = NOTHING;
  compared = 0; // [ms] since when lines of a turn are shown
  frame = 0; // asked for
  began = -Infinity; // [ms] the last one
  wasLive = true;

  constructor(element, store) {
    Object.assign(this, { element, store });
    const { view } = this;
    const parts = partsOf(element);
    this.surface = new Surface(view, parts.canvas, () => this.measure());
    this.following = new Following(view);
    this.framing = new Framing(view, this.following);
    this.deciding = new Deciding(store, () => this.request());
    this.colours = new Colours(parts.probe);
    this.steering = new Steering(view, this.following, this.framing, () => this.ego, (following) => {
      this.around.following(following);
      this.request();
    });
    this.steered = {
      zoomIn: () => this.steering.zoomIn(),
      zoomOut: () => this.steering.zoomOut(),
      fit: () => this.fit(),
      follow: () => this.steering.follow(),
    };
    const both = () => this.steering.fit(boundsOfEvidence(store.evidence));
    this.around = new Around(parts, store, view, { ...this.steered, both }, () => this.changed());
    this.choosing = new Choosing(parts.card, store, view, this.around.summary, () => this.changed());
    this.listen(parts.canvas);
    this.roadsCame();
    this.measure();
  }

  listen(canvas) {
    const { store } = this;
    const request = () => this.request();
    store.addEventListener("shown", () => void (this.compared = performance.now()));
    store.addEventListener("ride", () => this.begin());
    store.addEventListener("roads", () => this.roadsCame());
    store.addEventListener("scene", () => this.sceneCame());
    store.addEventListener("moment", () => this.momentCame());
    store.addEventListener("decisions", () => this.deciding.update());
    on(store, "roads decisions status", request);
    on(store, "ride shown pointed preview", () => this.changed());
    const recoloured = () => {
      this.colours.forget();
      this.backdrop.spoil();
      this.sprites.forget();
      this.changed();
    };
    window.addEventListener("theme", recoloured);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", recoloured);
    this.view.still.addEventListener("change", request);
    new ResizeObserver(() => this.measure()).observe(this.element);
    window.addEventListener("resize", () => this.measure()); // also when only the density changes
    canvas.addEventListener("focus", () => this.around.summary.announced(true));
    canvas.addEventListener("blur", () => this.around.summary.announced(false));
    listen(canvas, {
      ...this.steered,
      pan: (dx, dy, pinching = false) => this.steering.pan(dx, dy, pinching),
      zoom: (factor, x, y) => this.steering.zoomAt(factor, x, y),
      hover: (x, y) => this.hover(this.choosing.at(x, y)),
      leave: () => this.hover(null),
      choose: (x, y) => this.choosing.choose(this.choosing.at(x, y)),
      next: (step) => this.choosing.next(step, this.drawn.vehicles),
      escape: () => (this.choosing.chosen === null ? false : this.choosing.choose(null)),
    });
  }

  /** A live scene came: where nothing moved, nothing need be drawn. */
  sceneCame() {
    this.motion.arrive(this.store.latest, performance.now());
    this.around.updateBadge();
    if (!this.motion.still) this.request();
  }

  /** Another moment is shown; live only since a scene came, see there. */
  momentCame() {
    this.deciding.update();
    if (!this.store.live || !this.wasLive) this.request();
    this.wasLive = this.store.live;
  }

  hover(id) {
    if (id === this.choosing.hovered) return;
    this.choosing.hovered = id;
    this.surface.canvas.classList.toggle("map-over", id !== null);
    this.changed();
  }

  begin() {
    this.motion.reset();
    this.following.reset();
    this.framing.reset();
    this.deciding.keep(null);
    this.choosing.chosen = null;
    this.scene = null;
    this.roadsCame();
  }

  roadsCame() {
    this.roads = this.store.roads ? new RoadLayer(this.store.roads) : null;
    this.backdrop.spoil();
  }

  measure() {
    const first = this.view.width === 0;
    if (!this.surface.fit(this.element)) return;
    if (first) this.view.scale = this.view.usual;
    this.around.forget();
    this.labels.spoil();
    this.draw(performance.now()); // at once: a canvas that changed its size is empty
  }

  get ego() {
    return this.scene?.vehicles.find((vehicle) => vehicle.id === 0);
  }

  /** Show everything there is. */
  fit() {
    const vehicles = this.scene?.vehicles ?? [];
    this.steering.fit(this.roads?.bounds ?? boundsOf(vehicles.map(({ x, y }) => [x, y]), 30));
  }

  /** Something is chosen or coloured otherwise: labels are too. */
  changed() {
    this.labels.spoil();
    this.request();
  }

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
    const { store, pace } = this;
    this.began = now;
    this.scene = this.sceneNow(began);
    this.choosing.vehicles = this.scene?.vehicles ?? [];
    this.move(began);
    const settling = this.drawBackdrop(began);
    this.drawn = this.scene ? this.drawScene(began) : NOTHING;
    this.besides(began);
    if (this.scene && store.live) pace.painted(store.latest, this.motion.reached(began) ?? store.latest);
    pace.frame(began, performance.now());
    const moving = settling || this.moving(began);
    if (moving) this.request();
    if (this.surface.drawn(moving, () => pace.rate(began), began)) this.measure();
  }

  sceneNow(now) {
    const { live, latest, past, at } = this.store;
    if (!latest) return null;
    if (live) return this.motion.live(now) ?? latest;
    if (!past.length || at >= latest.t) return latest;
    const index = Math.max(lastUpTo(past, at), 0);
    return sceneAt([past[index], past[index + 1] ?? latest], at);
  }

  move(now) {
    const before = this.view.scale;
    if (this.ego && this.framing.due(now)) {
      const { causes, about } = toldOf(this.store);
      const told = new Set([...causes, ...about]);
      const around = { vehicles: this.scene.vehicles, told, detail: this.deciding.detail, roads: this.roads };
      this.framing.step(this.ego, pointsThatMatter(this.ego, around), now);
    }
    this.view.step(now);
    this.following.zoomed(this.view.scale / before);
    this.following.step(this.ego, now);
  }

  moving(now) {
    const live = this.store.live && this.motion.moving(now);
    const looping = !this.view.still.matches && this.drawn.fact + this.drawn.ghost > 0; // ghosts, on their lines
    const unplaced = this.scene !== null && this.labels.stale;
    return live || this.view.glide !== null || !this.following.settled || looping || unplaced;
  }

  drawBackdrop(now) {
    const { colours, view } = this;
    this.backdrop.ground = colours.get("ground");
    return this.backdrop.show(this.surface.context, view, now, (context, bounds) => {
      this.spacing = null;
      if (this.roads) this.roads.draw(context, bounds, view.scale, colours);
      else if (this.scene) this.spacing = drawGrid(context, bounds, view.scale, colours);
    });
  }

  drawScene(now) {
    const { store, view, colours, labels, sprites, roads } = this;
    const { evidence, preview } = store;
    const { causes, about } = toldOf(store);
    const elapsed = view.still.matches ? null : (now - this.compared) / 1000;
    const spokenOf = { causes, pointed: new Set([...store.pointed, ...about]), chosen: this.choosing.id };
    labels.begin(view, colours.font, this.around.rectangles(this.element), now);
    return drawPicture(
      { ...this.scene, ...spokenOf, detail: this.deciding.detail, evidence, preview, elapsed },
      { context: this.surface.context, view, colours, labels, sprites, roads },
    );
  }

  /** What is no part of the canvas: as seldom as labels are placed, but for the card of a vehicle. */
  besides(now) {
    const { scene, drawn, roads } = this;
    const spacing = scene && !roads ? this.spacing : null;
    if (!scene || this.labels.placing) this.around.update(this.element, { scene, drawn, spacing });
    this.choosing.place();
    if (scene) this.around.tell(scene, roads, now);
  }

  shown() {
    const { kinds, ...drawn } = this.drawn;
    const { causes, about } = toldOf(this.store);
    const pointed = new Set([...this.store.pointed, ...about, ...causes]);
    pointed.delete(0);
    return {
      t: this.scene?.t ?? null,
      ...drawn,
      pointed: [...pointed],
      causes: [...causes],
      follow: this.following.on,
      scale: this.view.scale,
    };
  }
}
