// The drawn world: puts things where a state says that they are, lets them be dragged, shows values over the cells.
// What stands where follows models/world/picture/layout.py; a test compares the two.

import { make, picture, shown, still } from "./dom.js";

const CELL = 100, FIXTURE = [67, 31], ROBOT = [28, 47], FLOOR = 73, HELD = [19, -14], SHRUNK = 0.66, DEEPEST = 8;
const LEAST_CELL = 56; // pixels of the screen: what is written in a cell can be read
const SVG = "http://www.w3.org/2000/svg";

export class World {
  constructor(place, { onmove }) {
    this.place = place;
    this.onmove = onmove;
    this.state = {};
    this.movable = true;
  }

  /** Show the picture of a world, as the server drew it, in a state. */
  load(svg, state) {
    this.svg = picture(svg);
    this.svg.removeAttribute("width");
    this.svg.removeAttribute("height");
    this.place.replaceChildren(this.svg);
    this.cells = new Map();
    for (const rect of this.svg.querySelectorAll("[data-cell]"))
      this.cells.set(rect.dataset.cell, [Number(rect.getAttribute("x")), Number(rect.getAttribute("y"))]);
    this.called = new Map([...this.svg.querySelectorAll("[data-cell]")].map((rect) => [rect.dataset.cell, rect.dataset.says]));
    this.things = new Map();
    for (const group of this.svg.querySelectorAll("[data-object]")) this.things.set(group.dataset.object, group);
    this.robot = [...this.things.values()].find((group) => group.dataset.robot)?.dataset.object;
    this.rows = 1 + Math.max(0, ...[...this.cells.values()].map(([, top]) => top / CELL));
    this.columns = 1 + Math.max(0, ...[...this.cells.values()].map(([left]) => left / CELL));
    this.drawn = this.cells.size > 0;
    if (this.drawn) {
      this.svg.classList.add(this.columns * this.rows <= 4 ? "small" : "large");
      this.svg.style.minWidth = `${this.columns * LEAST_CELL}px`;
      this.over = document.createElementNS(SVG, "g");
      this.over.setAttribute("class", "over");
      this.svg.querySelector(".way").before(this.over);
      this.said = document.createElementNS(SVG, "g"); // above the things: it must be read
      this.said.setAttribute("class", "over");
      this.svg.querySelector(".things").after(this.said);
      for (const [name, group] of this.things) if (!group.dataset.fixed) this.#drag(name, group);
    }
    this.show(state);
  }

  /** Put everything where it is in a state. */
  show(state) {
    this.state = state;
    if (!this.drawn) {
      this.place.replaceChildren(make("p", { class: "listed" }, this.words(state)));
      return;
    }
    const spots = this.spots(state);
    for (const [name, group] of this.things) {
      const spot = spots.get(name);
      if (!spot) continue;
      group.style.transform = `translate(${spot.x}px, ${spot.y}px) scale(${spot.scale})`;
      group.classList.toggle("inside", spot.host !== undefined);
      const status = group.querySelector("[data-part=status]");
      if (status) status.textContent = group.dataset.status.split(" ").map((a) => shown(state[name][a])).join(", ");
    }
    this.svg.querySelector("title").textContent = this.words(state);
    this.#follow(spots.get(this.robot));
  }

  /** Where not all of the world fits in, the part where the robot is. */
  #follow(spot) {
    const { scrollWidth, clientWidth } = this.place;
    this.place.tabIndex = scrollWidth > clientWidth ? 0 : -1;
    if (spot && scrollWidth > clientWidth)
      this.place.scrollLeft = (scrollWidth * (spot.x + CELL / 2)) / (CELL * this.columns) - clientWidth / 2;
  }

  /** What people call a cell, a thing or a value. */
  says(name) {
    return this.called.get(name) ?? shown(name);
  }

  /** A state in words; with `before`, only what is not as in that. */
  words(state, before = {}) {
    return Object.entries(state).flatMap(([name, attributes]) =>
      Object.entries(attributes).filter(([attribute, value]) => before[name]?.[attribute] !== value)
        .map(([attribute, value]) => `${shown(name)} ${attribute} ${this.says(value)}`)).join(", ");
  }

  /** Where each thing is drawn in a state. */
  spots(state) {
    const hosts = new Map([...this.things.keys()].map((name) => [name, this.#host(name, state)]));
    const spots = new Map();
    for (const [cell, [left, top]] of this.cells) {
      const here = [...hosts].filter(([, host]) => host === cell).map(([name]) => name);
      const lying = here.filter((name) => name !== this.robot && !this.things.get(name).dataset.fixed);
      for (const name of here) {
        if (this.things.get(name).dataset.fixed) spots.set(name, { x: left + FIXTURE[0], y: top + FIXTURE[1], scale: 1 });
        else if (name === this.robot) spots.set(name, { x: left + ROBOT[0], y: top + ROBOT[1], scale: 1 });
      }
      lying.forEach((name, number) =>
        spots.set(name, { x: left + (CELL * (number + 1)) / (lying.length + 1), y: top + FLOOR, scale: 1 }));
    }
    [...hosts].filter(([, host]) => host === undefined).forEach(([name], number) =>
      spots.set(name, { x: CELL * (number + 0.5), y: CELL * this.rows + 40, scale: 1 }));
    for (let depth = 0; depth < DEEPEST; depth++)
      for (const host of [...spots.keys()]) {
        const inside = [...hosts].filter(([name, owner]) => owner === host && !spots.has(name)).map(([name]) => name);
        const base = spots.get(host);
        inside.forEach((name, number) => {
          const [dx, dy] = host === this.robot ? HELD : [11 * (number - (inside.length - 1) / 2), -9];
          spots.set(name, { x: base.x + base.scale * dx, y: base.y + base.scale * dy, scale: base.scale * SHRUNK, host });
        });
      }
    return spots;
  }

  #host(name, state) {
    const fixed = this.things.get(name).dataset.fixed;
    return fixed ?? Object.values(state[name] ?? {}).find((value) => this.cells.has(value) || (this.things.has(value) && value !== name));
  }

  /** The attribute that says where a thing is. */
  whereabouts(name) {
    const attributes = this.state[name] ?? {};
    return Object.keys(attributes).find((a) => this.cells.has(attributes[a]) || this.things.has(attributes[a])) ?? Object.keys(attributes)[0];
  }

  /** What can be moved by hand. */
  moving() {
    return [...this.things].filter(([, group]) => !group.dataset.fixed).map(([name]) => name);
  }

  /** The state in which a thing is in a cell. */
  moved(name, cell) {
    const state = structuredClone(this.state);
    state[name][this.whereabouts(name)] = cell;
    return state;
  }

  #drag(name, group) {
    group.classList.add("movable");
    group.addEventListener("pointerdown", (event) => {
      if (!this.movable || event.button) return;
      event.preventDefault();
      event.stopPropagation();
      group.setPointerCapture(event.pointerId);
      group.classList.add("dragged");
      this.onmove.begin?.();
      const follow = (move) => {
        const [x, y] = this.#point(move);
        group.style.transform = `translate(${x}px, ${y}px) scale(1.1)`;
        this.#mark(this.#cellAt(x, y));
      };
      const drop = (end) => {
        group.removeEventListener("pointermove", follow);
        group.removeEventListener("pointerup", drop);
        group.removeEventListener("pointercancel", drop);
        group.classList.remove("dragged");
        this.#mark(undefined);
        const cell = end.type === "pointerup" ? this.#cellAt(...this.#point(end)) : undefined;
        const from = this.state[name][this.whereabouts(name)];
        this.show(this.state);
        if (cell !== undefined && cell !== from) this.onmove.end(name, cell);
        else this.onmove.cancel?.();
      };
      group.addEventListener("pointermove", follow);
      group.addEventListener("pointerup", drop);
      group.addEventListener("pointercancel", drop);
    });
  }

  #point(event) {
    const matrix = this.svg.querySelector(".things").getScreenCTM().inverse();
    const point = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix);
    return [point.x, point.y];
  }

  #cellAt(x, y) {
    for (const [cell, [left, top]] of this.cells) if (x >= left && x < left + CELL && y >= top && y < top + CELL) return cell;
    return undefined;
  }

  #mark(cell) {
    for (const rect of this.svg.querySelectorAll("[data-cell]")) rect.classList.toggle("target", rect.dataset.cell === cell);
  }

  /** The way of a run, as a dotted line; states in order. */
  trail(states) {
    const way = this.svg.querySelector(".way");
    if (!this.drawn || !way) return;
    const points = states.map((state) => this.spots(state).get(this.robot)).filter(Boolean);
    const line = document.createElementNS(SVG, "polyline");
    line.setAttribute("class", "trail");
    line.setAttribute("points", points.map(({ x, y }) => `${x},${y}`).join(" "));
    way.replaceChildren(...(points.length > 1 ? [line] : []));
  }

  /** Values and arrows over the cells: `[{cell, heat, text, arrow}]`, heat from 0 (far) to 1 (there). */
  overlay(items) {
    if (!this.drawn) return;
    this.over.replaceChildren(...items.filter(({ heat }) => heat !== undefined).map(({ cell, heat }) => {
      const [left, top] = this.cells.get(cell);
      const rect = shape("rect", { x: left + 2, y: top + 2, width: CELL - 4, height: CELL - 4, class: "heat" });
      rect.style.fillOpacity = 0.05 + 0.45 * heat;
      return rect;
    }));
    this.said.replaceChildren(...items.flatMap(({ cell, text, arrow }) => {
      const [left, top] = this.cells.get(cell);
      const parts = [];
      if (text) parts.push(shape("text", { x: left + CELL - 6, y: top + 84, class: "value" }, text));
      if (arrow.length > 1) parts.push(shape("text", { x: left + 5, y: top + 90, class: "doing" }, arrow));
      else if (arrow) parts.push(shape("text", { x: left + 7, y: top + 92, class: "arrow-sign" }, arrow));
      return parts;
    }));
  }

  transitions(milliseconds) {
    this.place.style.setProperty("--move", still() ? "0ms" : `${milliseconds}ms`);
  }
}

function shape(tag, attributes, text) {
  const element = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  if (text) element.textContent = text;
  return element;
}
