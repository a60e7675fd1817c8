/** The map: a canvas, its controls, and when they are drawn anew. */

import { lastUpTo } from "../store.js";
import { Around } from "./around.js";
import { Backdrop } from "./backdrop.js";
import { Choosing } from "./choosing.js";
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
import { Sprites } from "./sprites.js";
import { Steering } from "./steering.js";
import { Surface } from "./surface.js";
import { toldOf } from "./told.js";
import { View } from "./view.js";

const BUSY = 14; // [ms] a frame that takes longer is drawn at most 30 times a second
const SPARE = 30; // [ms]
const NOTHING = {
  vehicles: [],
  labels: [],
  ghost: 0,
  fact: 0,
  predictions: 0,
  yields: 0,
  lights: 0,
  hidden: false,
  imagined: 0,
  preview: false,
  kinds: new Set(),
};
const WORDED = new Set(["ride", "shown", "pointed", "preview"]); // changes by which other labels are wanted
const LABEL =
  "Map of the drive. Arrow keys move it, plus and minus zoom, 0 shows everything, F follows our car, " +
  "N and P, or the square brackets, go through the vehicles in view, Escape lets go of them.";
const ATTRIBUTES = {
  tabindex: 0,
  role: "application",
  "aria-roledescription": "map",
  "aria-label": LABEL,
  "aria-describedby": "map-in-words",
};

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
    fit: () => map.steering.fit(map.everything),
    follow: (on = !map.following.on) => map.steering.follow(on),
    zoom: (factor) => map.steering.zoom(factor),
    shown: () => map.shown(),
    frames: () => map.pace.figures(performance.now()),
  };
}

class LiveMap {
  constructor(element, store) {
    this.element = element;
    this.store = store;
    this.view = new View();
    this.surface = new Surface(this.view, ATTRIBUTES, () => this.measure());
    const { canvas, context } = this.surface;
    Object.assign(this, { canvas, context });
    this.following = new Following(this.view);
    this.framing = new Framing(this.view, this.following);
    this.motion = new Motion();
    this.backdrop = new Backdrop();
    this.labels = new Labels();
    this.sprites = new Sprites();
    this.pace = new Pace();
    this.deciding = new Deciding(store, () => this.request());
    this.roads = null;
    this.scene = null; // that is drawn: {t, vehicles}
    this.drawn = NOTHING;
    this.compared = 0; // [ms] since when lines of a turn are shown
    this.frame = 0; // asked for
    this.began = -Infinity; // [ms] the last one
    this.wasLive = true;
    this.build();
    this.listen();
    this.roadsCame();
    this.measure();
  }

  build() {
    this.steering = new Steering(
      this.view,
      this.following,
      this.framing,
      () => this.ego,
      (following) => {
        this.around.controls.following(following);
        this.request();
      },
    );
    const { steering } = this;
    this.steered = {
      zoomIn: () => steering.zoomIn(),
      zoomOut: () => steering.zoomOut(),
      fit: () => steering.fit(this.everything),
      follow: () => steering.follow(!this.following.on),
    };
    const on = { ...this.steered, both: () => steering.fit(boundsOfEvidence(this.store.evidence)) };
    this.around = new Around(this.store, this.view, on, () => this.changed());
    this.choosing = new Choosing(this.store, this.view, this.around.summary, () => this.changed());
    this.element.classList.add("map");
    this.element.append(this.canvas, ...this.around.elements, this.choosing.card.element);
    this.colours = new Colours(this.element);
  }

  listen() {
    const on = {
      ride: () => this.begin(),
      roads: () => this.roadsCame(),
      scene: () => this.sceneCame(),
      moment: () => this.momentCame(),
      decisions: () => this.deciding.update(),
      shown: () => void (this.compared = performance.now()),
      pointed: () => {},
      preview: () => {},
      status: () => {},
    };
    for (const [name, change] of Object.entries(on)) {
      this.store.addEventListener(name, () => {
        if (change() === false) return;
        if (WORDED.has(name)) this.labels.spoil();
        this.request();
      });
    }
    const recoloured = () => {
      this.colours.read();
      this.backdrop.spoil();
      this.sprites.forget();
      this.changed();
    };
    window.addEventListener("theme", recoloured);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", recoloured);
    this.view.still.addEventListener("change", () => this.request());
    new ResizeObserver(() => this.measure()).observe(this.element);
    window.addEventListener("resize", () => this.measure()); // also when only the density changes
    this.canvas.addEventListener("focus", () => this.around.summary.announced(true));
    this.canvas.addEventListener("blur", () => this.around.summary.announced(false));
    this.touched();
  }

  touched() {
    listen(this.canvas, {
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

  /** A live scene came; false: nothing moved, so that nothing need be drawn. */
  sceneCame() {
    this.motion.arrive(this.store.latest, performance.now());
    this.around.badge.update(this.store);
    return !this.motion.still;
  }

  /** Another moment is shown; false: only since a scene came, see there. */
  momentCame() {
    this.deciding.update();
    const went = this.store.live && this.wasLive;
    this.wasLive = this.store.live;
    return !went;
  }

  hover(id) {
    if (id === this.choosing.hovered) return;
    this.choosing.hovered = id;
    this.canvas.classList.toggle("map-over", id !== null);
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

  /** Bounds of everything there is. */
  get everything() {
    return this.roads?.bounds ?? boundsOf(this.scene?.vehicles.map(({ x, y }) => [x, y]) ?? [], 30);
  }

  /** Something is chosen or coloured otherwise: labels are too. */
  changed() {
    this.labels.spoil();
    this.request();
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
    this.choosing.vehicles = this.scene?.vehicles ?? [];
    this.move(began);
    const settling = this.backdropNow(began);
    this.drawn = this.scene ? this.pictureNow(began) : NOTHING;
    this.besides(began);
    if (this.scene && this.store.live)
      this.pace.painted(this.store.latest, this.motion.reached(began) ?? this.store.latest);
    this.pace.frame(began, performance.now());
    const moving = settling || this.moving(began);
    if (moving) this.request();
    if (this.surface.drawn(moving, () => this.pace.rate(began), began)) this.measure();
  }

  sceneNow(now) {
    const { store } = this;
    if (!store.latest) return null;
    if (store.live) return this.motion.live(now) ?? store.latest;
    if (!store.past.length || store.at >= store.latest.t) return store.latest;
    const index = Math.max(lastUpTo(store.past, store.at), 0);
    return sceneAt([store.past[index], store.past[index + 1] ?? store.latest], store.at);
  }

  move(now) {
    const before = this.view.scale;
    if (this.ego && this.framing.due(now)) this.frameAnew(this.ego, now);
    this.view.step(now);
    this.following.zoomed(this.view.scale / before);
    this.following.step(this.ego, now);
  }

  frameAnew(ego, now) {
    const { causes, about } = toldOf(this.store);
    const around = { vehicles: this.scene.vehicles, told: new Set([...causes, ...about]) };
    const points = pointsThatMatter(ego, { ...around, detail: this.deciding.detail, roads: this.roads });
    this.framing.step(ego, points, now);
  }

  moving(now) {
    const live = this.store.live && this.motion.moving(now);
    const drawing = live || this.view.glide !== null || !this.following.settled || this.looping;
    return drawing || (this.scene !== null && this.labels.stale);
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
    const { causes, about } = toldOf(store);
    this.labels.begin(view, this.colours.font, this.around.rectangles(this.element), now);
    return drawPicture(
      {
        ...this.scene,
        detail: this.deciding.detail,
        evidence,
        preview: store.preview,
        elapsed: view.still.matches ? null : (now - this.compared) / 1000,
        causes,
        pointed: new Set([...store.pointed, ...about]),
        chosen: this.choosing.id,
      },
      {
        context: this.context,
        view,
        colours: this.colours,
        labels: this.labels,
        sprites: this.sprites,
        roads: this.roads,
      },
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
