// A whole policy, read as docs/http.md ("Acting") says: what it would do, and how good that is, in any state.

import { request } from "./api.js";

const LARGEST = 3_000_000; // entries; more would be slow to fetch
const SIGNS = { north: "↑", south: "↓", east: "→", west: "←" };

export class Policy {
  /** The policy of a plan, or null where it is too large to be shown. */
  static async of(plan) {
    if (!plan.policy || plan.policy.states * plan.policy.memories > LARGEST) return null;
    return new Policy((await request("GET", plan.policy.url)).body);
  }

  constructor(data) {
    this.data = data;
    this.digits = data.variables.map((variable) => new Map(variable.values.map((value, digit) => [value, digit])));
    this.index = data.indices && new Map(data.indices.map((sum, place) => [sum, place]));
  }

  /** Action, probability and expected steps in a state with a memory; null where the policy says nothing. */
  at(state, memory) {
    const { data } = this;
    let sum = 0;
    for (const [position, variable] of data.variables.entries()) {
      const digit = this.digits[position].get(state[variable.object]?.[variable.attribute]);
      if (digit === undefined || !variable.harmless.includes(digit)) return null;
      sum += variable.stride * digit;
    }
    const place = this.index ? this.index.get(sum) : sum;
    if (place === undefined || data.letter[place] < 0) return null;
    const after = data.automaton.successors[memory][data.letter[place]];
    const row = data.automaton.row[after];
    if (row < 0) return { action: null, probability: data.automaton.accepted[after], steps: 0 };
    const entry = row * data.places + place;
    const action = data.action[entry];
    return { action: action >= 0 ? data.actions[action] : null, probability: data.probability[entry], steps: data.expected_steps[entry] };
  }

  /** What `World.overlay` shows: for each cell, as if the robot were there and all else as it is. */
  over(world, memory, { values, arrows }) {
    const attribute = world.robot && world.whereabouts(world.robot);
    if (!attribute) return [];
    const found = [];
    for (const cell of world.cells.keys()) {
      const state = { ...world.state, [world.robot]: { ...world.state[world.robot], [attribute]: cell } };
      const here = this.at(state, memory);
      if (here) found.push({ cell, ...here });
    }
    const most = Math.max(1, ...found.filter((here) => here.probability > 0).map((here) => here.steps));
    return found.map(({ cell, action, probability, steps }) => ({
      cell,
      heat: values ? probability * (1 - (0.9 * steps) / most) : undefined,
      text: values ? (probability > 0.9995 ? steps.toFixed(1) : `${Math.round(100 * probability)} %`) : "",
      arrow: arrows && action ? (SIGNS[action] ?? action.split("(")[0]) : "",
    }));
  }
}
