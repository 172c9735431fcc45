// A run of a policy, played step by step: what happens by chance is drawn by the server, from a seed.

import { request } from "./api.js";

const AHEAD = 200; // steps asked for at once

export class Player {
  /** `onstep(step, number, next)` is called whenever another step is shown, `onplay(playing)` when that changes. */
  constructor({ onstep, onplay, onerror }) {
    Object.assign(this, { onstep, onplay, onerror });
    this.steps = [];
    this.at = 0;
    this.seed = 0;
    this.speed = 2;
    this.timer = null;
  }

  get now() {
    return this.steps[this.at];
  }

  get playing() {
    return this.timer !== null;
  }

  /** Whether nothing follows what is shown. */
  get over() {
    return !this.now || ["satisfied", "lost"].includes(this.now.status);
  }

  stop() {
    this.steps = [];
    this.url = null;
    this.pause();
  }

  /** The request for a run from a state with a memory, by default from where the plan began. */
  body(from) {
    return { seed: this.seed, max_steps: AHEAD, ...from };
  }

  /** Begin with a policy, or go on with it from somewhere else. */
  async begin(url, from = {}) {
    const found = (await request("POST", `${url}/run`, this.body(from))).body;
    this.url = url;
    this.steps = found.steps;
    this.at = 0;
    this.#show();
  }

  play() {
    if (this.playing || !this.url) return;
    this.timer = setTimeout(() => this.#tick(), 150);
    this.onplay(true);
  }

  pause() {
    clearTimeout(this.timer);
    this.timer = null;
    this.onplay(false);
  }

  /** One step on; false where nothing follows. */
  async step() {
    if (this.over) return false;
    if (this.at + 1 >= this.steps.length) {
      const { state, memory } = this.now;
      const { url } = this;
      this.seed += 1;
      const more = (await request("POST", `${url}/run`, this.body({ state, memory }))).body.steps;
      if (url !== this.url) return false;
      this.steps = [...this.steps.slice(0, -1), ...more];
      if (this.at + 1 >= this.steps.length) return false;
    }
    this.at += 1;
    this.#show();
    return true;
  }

  async #tick() {
    try {
      const more = (await this.step()) && !this.over;
      if (!this.playing) return;
      if (more) this.timer = setTimeout(() => this.#tick(), 1000 / this.speed);
      else this.pause();
    } catch (error) {
      this.pause();
      this.onerror(error);
    }
  }

  #show() {
    this.onstep(this.now, this.at, this.steps);
  }
}
