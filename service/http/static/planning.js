// Asking for a plan: at once where it is quick, else as a job with its progress and a way to cancel it.

import { Problem, curlBlock, events, request } from "./api.js";
import { byId, make, show } from "./dom.js";

const WAIT = { Prefer: "wait=1" };
export const HEADERS = WAIT;

let cancelled = null; // what the Cancel button does

/** The plan, or null when it was cancelled. Throws `Problem`. */
export async function plan(body, { signal } = {}) {
  const answer = await request("POST", "/plan", body, { headers: WAIT, signal });
  if (answer.status !== 202) return answer.body;
  return await ended(answer.body, signal);
}

async function ended(job, signal) {
  const bar = byId("progress-bar");
  show(byId("progress"));
  bar.removeAttribute("value");
  byId("progress-text").textContent = "";
  byId("cancel").disabled = false;
  byId("progress-curl").replaceChildren(curlBlock({ aim: "following it" }, "GET", `${job.url}/events`), curlBlock({ aim: "cancelling it" }, "POST", `${job.url}/cancel`));
  const stop = () => {
    byId("cancel").disabled = true;
    request("POST", `${job.url}/cancel`).catch(() => {});
  };
  cancelled = stop;
  signal?.addEventListener("abort", stop);
  try {
    const end = await lastOf(`${job.url}/events`);
    if (end.state === "failed") throw new Problem(end.error);
    return end.state === "cancelled" ? null : end.plan;
  } finally {
    cancelled = null;
    signal?.removeEventListener("abort", stop);
    show(byId("progress"), false);
  }
}

/** The job as it ended; until then its progress is shown. */
async function lastOf(stream) {
  for await (const { name, data } of events(stream)) {
    if (name === "end") return data;
    if (name === "progress") tellProgress(data);
  }
}

function tellProgress({ state, progress }) {
  const bar = byId("progress-bar");
  const parts = [state === "queued" ? "waiting for its turn" : (progress.stage ?? "starting")];
  if (progress.states) parts.push(`${progress.states.toLocaleString("en")} states`);
  if (progress.lower != null && progress.upper != null) {
    parts.push(`between ${progress.lower.toPrecision(3)} and ${progress.upper.toPrecision(3)}`);
    if (progress.stage === "probability") bar.value = Math.max(0, 1 - (progress.upper - progress.lower));
  }
  if (progress.elapsed_s) parts.push(`${progress.elapsed_s.toFixed(0)} s`);
  if (progress.remaining_s) parts.push(`about ${Math.ceil(progress.remaining_s)} s left`);
  byId("progress-text").textContent = parts.join(" · ");
}

byId("cancel").addEventListener("click", () => cancelled?.());

const WORDS = {
  unsatisfiable: "cannot be done: the formula contradicts itself",
  unreachable: "cannot be done in this world, from here",
};

/** What a plan promises, with its bounds. */
export function showPromise(found) {
  show(byId("promise-empty"), false);
  const { lower, upper } = found.probability;
  const lines = [];
  if (found.outcome !== "solved") lines.push(["Outcome", WORDS[found.outcome], found.obstacles.map((why) => why.explanation).join("; ")]);
  const goal = found.objective === "min" ? "at least" : "at most";
  lines.push(["Probability", percent(lower, upper), upper - lower < 1e-9 ? "exactly" : `between ${exact(lower)} and ${exact(upper)}; no policy does better than ${goal === "at most" ? exact(upper) : exact(lower)}`]);
  if (found.expected_steps != null && !(found.expected_steps === 0 && found.round_steps)) {
    const most = found.expected_steps_upper;
    lines.push(["Expected steps", found.expected_steps.toFixed(2), most == null ? "at least" : `between ${exact(found.expected_steps)} and ${exact(most)}`]);
  }
  if (found.round_steps && found.round_steps.lower > 1.0001) {
    const { lower: least, upper: most } = found.round_steps;
    lines.push(["Steps a round, for ever", least.toFixed(2), most == null ? "at least" : `between ${exact(least)} and ${exact(most)}`]);
  }
  lines.push(["Looked at", `${found.model.product_states.toLocaleString("en")} states`, `${found.model.states.toLocaleString("en")} of the world × ${found.model.automaton_states} of the automaton`]);
  lines.push(["Planned in", found.timing.total_s < 1 ? `${(1000 * found.timing.total_s).toFixed(0)} ms` : `${found.timing.total_s.toFixed(1)} s`]);
  byId("promise").replaceChildren(...lines.map(([term, value, note]) =>
    make("div", {}, make("dt", {}, term), make("dd", {}, make("strong", {}, value), note ? make("span", { class: "note" }, note) : null))));
  show(byId("promise"));
}

export function hidePromise() {
  show(byId("promise"), false);
  show(byId("promise-empty"));
  byId("plan-curl").replaceChildren();
}

const exact = (number) => String(Number(number.toPrecision(9)));
const percent = (lower, upper) => (upper - lower < 1e-5 ? `${trim(100 * lower)} %` : `${trim(100 * lower)} to ${trim(100 * upper)} %`);
const trim = (number) => String(Number(number.toFixed(3)));
