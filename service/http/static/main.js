// The page: a command goes from the sentence to a run in the world.

import { Problem, request, tellCurl, useKey } from "./api.js";
import { hideAutomaton, light, showAutomaton } from "./automaton.js";
import { byId, make, show, shown, tell } from "./dom.js";
import { HEADERS, hidePromise, plan, showPromise } from "./planning.js";
import { Player } from "./player.js";
import { Policy } from "./policy.js";
import { offer, prepareTeaching } from "./teaching.js";
import { hideUnderstanding, showUnderstanding } from "./understanding.js";
import { World } from "./world.js";

const FIRST = ["house", "warehouse", "city", "toys", "navigation"]; // the order of the worlds that come with the service

let environment = null; // as stored: name, spec, samples
let initial = {}; // its state at first
let start = null; // where things were moved before anything was planned; null: nowhere
let slip = null; // where the visitor set it; null: as the world has it
let asked = null; // the command that is planned: {text, answers}
let current = null; // its plan
let policy = null; // the whole of it, once values or arrows were asked for
let working = null; // aborts what goes on

const world = new World(byId("world"), { onmove: { begin: () => player.pause(), end: move } });
const player = new Player({ onstep: showStep, onplay: showPlaying, onerror: (error) => refuse(error, "plan-problem") });

function refuse(error, place) {
  if (error.name === "AbortError") return;
  if (!(error instanceof Problem)) throw error;
  tell(place, error.message);
}

// The world

async function enter(name) {
  forget();
  tell("command-problem");
  environment = (await request("GET", `/environments/${encodeURIComponent(name)}`)).body;
  const { spec } = environment;
  initial = spec.kind === "explicit" ? { mdp: { state: String(spec.initial ?? 0) } } : (spec.state ?? {});
  start = null;
  await draw();
  byId("samples").replaceChildren(...environment.samples.map((text) =>
    make("li", {}, make("button", { type: "button", class: "chip", onclick: () => say(text) }, text))));
  show(document.querySelector(".samples"), environment.samples.length > 0);
  byId("command").placeholder = environment.samples[0] ?? "";
  offer(environment.spec.lessons?.[0]);
  slip = null;
  const usual = environment.spec.parameters?.slip;
  show(byId("slip-field"), usual !== undefined);
  if (usual !== undefined) showSlip(usual);
  history.replaceState(null, "", `#${encodeURIComponent(name)}`);
}

async function draw() {
  const path = `/environments/${encodeURIComponent(environment.name)}/image`;
  const { body } = await request("GET", path);
  world.load(body, initial);
  tellCurl(byId("run-curl"), "GET", path);
  byId("status").textContent = world.drawn ? "" : "This world has no map; its state is listed.";
  byId("move-what").replaceChildren(...world.moving().map((thing) => make("option", { value: thing }, shown(thing))));
  byId("move-where").replaceChildren(...[...world.cells.keys()].map((cell) => make("option", { value: cell }, world.says(cell))));
  show(document.querySelector(".more"), world.drawn);
}

function showSlip(value) {
  byId("slip").value = value;
  byId("slip-value").textContent = `${+(100 * value).toFixed(1)} %`;
}

/** Forget the plan, and put the world back. */
function forget() {
  working?.abort();
  player.stop();
  current = policy = asked = null;
  for (const id of ["play", "step", "restart", "values", "arrows"]) byId(id).disabled = true;
  show(byId("question"), false);
  show(byId("outcome"), false);
  tell("plan-problem");
  byId("policy-curl").replaceChildren();
  hideUnderstanding();
  hidePromise();
  hideAutomaton();
}

// From a sentence to a run

async function say(text, answers = []) {
  byId("command").value = text;
  forget();
  tell("command-problem");
  world.overlay([]);
  world.trail([]);
  world.show({ ...initial, ...start });
  working = new AbortController();
  const { signal } = working;
  asked = { text, answers };
  const body = { text, environment: environment.name, candidates: 3, ...(answers.length && { answers }), ...(start && { state: start }) };
  try {
    const translation = (await request("POST", "/translate", body, { signal })).body;
    const told = showUnderstanding(translation, body).catch((error) => refuse(error, "command-problem"));
    if (translation.outcome === "unknown") {
      const near = translation.nearest.length ? ` The nearest known ones are ${translation.nearest.join(", ")}.` : "";
      tell("command-problem", `No known task fits this.${near} You can teach it below.`);
    } else if (translation.question) ask(translation.question);
    else if (!translation.ltl) tell("command-problem", translation.issues.map((issue) => issue.detail).join("; "));
    else await perform({ text, ...(answers.length && { answers }) }, signal);
    await told;
  } catch (error) {
    refuse(error, error.about?.("/text") === undefined && current === null ? "plan-problem" : "command-problem");
  }
}

function ask(question) {
  byId("question-text").textContent = question.text.includes("; or: ") ? "Which of these do you mean?" : sentence(question.text);
  const buttons = question.choices.map((choice, number) => {
    const says = question.says[number];
    const answer = { choice, part: question.part, ...(question.argument != null && { argument: question.argument }) };
    const label = question.about === "thing" ? shown(choice) : sentence(says);
    return make("button", { type: "button", onclick: () => say(asked.text, [...asked.answers, answer]) }, label,
      question.about === "thing" && says !== choice ? make("span", { class: "note" }, says.replace(`${choice}: `, "")) : null);
  });
  const none = make("button", { type: "button", class: "plain", onclick: otherwise }, "None of these");
  byId("choices").replaceChildren(...buttons, none);
  show(byId("question"));
  buttons[0].focus();
}

/** Nothing that was offered is meant. */
async function otherwise() {
  await say(asked.text, [...asked.answers, { choice: null }]);
  byId("command").focus();
}

const sentence = (text) => text[0].toUpperCase() + text.slice(1);

/** Plan, show what is promised, and run it. */
async function perform(what, signal) {
  const body = { ...what, ...place(), ...(start && { state: start }) };
  tellCurl(byId("plan-curl"), "POST", "/plan", body, HEADERS);
  byId("status").textContent = "Planning…";
  const found = await plan(body, { signal });
  if (signal.aborted) return;
  if (found === null) {
    byId("status").textContent = "Planning was cancelled.";
    return;
  }
  current = found;
  policy = null;
  showPromise(found);
  badge(found);
  if (found.outcome !== "solved") {
    byId("status").textContent = found.outcome === "unsatisfiable" ? "No run at all satisfies the formula." : "No run of this world satisfies the formula from here.";
    return;
  }
  const drawn = showAutomaton(found.policy.url);
  for (const id of ["play", "step", "restart", "values", "arrows"]) byId(id).disabled = false;
  player.seed = 0;
  await player.begin(found.policy.url);
  tellCurl(byId("run-curl"), "POST", `${found.policy.url}/run`, player.body());
  await overlay();
  player.play();
  await drawn;
  if (player.now && !signal.aborted) light(player.now.memory_after, player.now.status);
}

/** The world to plan in: by name, or written out where the slip is another. */
function place() {
  if (slip === null || slip === environment.spec.parameters.slip) return { environment: environment.name };
  return { environment_spec: { ...environment.spec, parameters: { ...environment.spec.parameters, slip } } };
}

function badge(found) {
  const { outcome, probability } = found;
  const text = outcome === "solved" ? `✓ Solved, ${probability.lower > 0.999999 ? "certain" : `${(100 * probability.lower).toFixed(1)} %`}` : `✗ ${outcome}`;
  byId("outcome").textContent = text;
  byId("outcome").classList.toggle("bad", outcome !== "solved");
  show(byId("outcome"));
}

// The run

const ENDS = { satisfied: "Done: the task holds, whatever happens next.", lost: "Lost: it cannot be done any more from here." };

function showStep(step, number, steps) {
  world.transitions(Math.min(450, 700 / player.speed));
  const before = number ? steps[number - 1] : null;
  world.show(step.state);
  world.trail(steps.slice(Math.max(0, number - 60), number + 1).map((passed) => passed.state));
  light(step.memory_after, step.status);
  const done = before ? `${number}. ${before.action ?? "wait"}: ${world.words(step.state, before.state) || "nothing changes"}.` : "Ready.";
  const next = ENDS[step.status] ?? `Next: ${step.action ?? "wait"}${step.status === "running" ? `, ${step.expected_steps?.toFixed(1)} steps expected` : ", and so on for ever"}.`;
  byId("status").textContent = `${done} ${next}`;
  byId("status").dataset.status = step.status;
  byId("step").disabled = player.over;
  if (player.over) byId("play").textContent = "Play again";
  overlay();
}

function showPlaying(playing) {
  byId("play").textContent = playing ? "Pause" : player.over && player.steps.length ? "Play again" : "Play";
}

async function again() {
  player.seed += 1;
  const from = start ? { state: { ...initial, ...start } } : {};
  await player.begin(current.policy.url, from);
  tellCurl(byId("run-curl"), "POST", `${current.policy.url}/run`, player.body(from));
}

byId("play").addEventListener("click", guarded(async () => {
  if (player.playing) return player.pause();
  if (player.over) await again();
  player.play();
}));
byId("step").addEventListener("click", guarded(async () => {
  player.pause();
  await player.step();
}));
byId("restart").addEventListener("click", guarded(async () => {
  player.pause();
  await again();
}));
byId("speed").addEventListener("input", () => (player.speed = Number(byId("speed").value)));
player.speed = Number(byId("speed").value);

function guarded(action) {
  return async () => {
    tell("plan-problem");
    try {
      await action();
    } catch (error) {
      refuse(error, "plan-problem");
    }
  };
}

// Changing things

/** Put a thing into a cell, by hand: the policy carries on from there, or the plan is made anew. */
async function move(name, cell) {
  tell("plan-problem");
  const state = world.moved(name, cell);
  const playing = player.now && !player.over;
  const memory = player.now?.memory;
  const moved = `${sentence(shown(name))} was moved to ${world.says(cell)}.`;
  if (!current?.policy) {
    start = state;
    world.show(state);
    byId("status").textContent = `${moved} Plans begin from here.`;
    return;
  }
  try {
    const from = { state, memory };
    await player.begin(current.policy.url, from);
    tellCurl(byId("run-curl"), "POST", `${current.policy.url}/run`, player.body(from));
    byId("status").textContent = `${moved} The policy carries on. ${byId("status").textContent}`;
    if (playing || !player.over) player.play();
  } catch (error) {
    if (error.slug !== "invalid-state") return refuse(error, "plan-problem");
    start = state;
    const { text, answers } = asked;
    await say(text, answers);
    byId("status").textContent = `${moved} The plan was made anew from here. ${byId("status").textContent}`;
  }
}

byId("move").addEventListener("submit", (event) => {
  event.preventDefault();
  player.pause();
  move(byId("move-what").value, byId("move-where").value);
});

byId("back").addEventListener("click", () => {
  player.pause();
  start = null;
  if (asked && current) return say(asked.text, asked.answers);
  world.show(initial);
  byId("status").textContent = "Everything is where it was at first.";
});

byId("slip").addEventListener("input", () => {
  slip = Number(byId("slip").value);
  showSlip(slip);
});
byId("slip").addEventListener("change", () => asked && current && say(asked.text, asked.answers));

async function overlay() {
  const wanted = { values: byId("values").checked, arrows: byId("arrows").checked };
  if (!current?.policy || !player.now || !(wanted.values || wanted.arrows)) {
    byId("policy-curl").replaceChildren();
    return world.overlay([]);
  }
  if (policy === null) {
    policy = await Policy.of(current);
    if (policy === null) return tell("plan-problem", "This policy is too large to be fetched whole; values and arrows are not shown.");
  }
  tellCurl(byId("policy-curl"), "GET", current.policy.url);
  world.overlay(policy.over(world, player.now.memory, wanted));
}
for (const id of ["values", "arrows"]) byId(id).addEventListener("change", guarded(overlay));

// The beginning

byId("say").addEventListener("submit", (event) => {
  event.preventDefault();
  const text = byId("command").value.trim() || byId("command").placeholder;
  if (text) say(text);
});
byId("world-name").addEventListener("change", guarded(() => enter(byId("world-name").value)));
prepareTeaching({
  environment: () => environment.name,
  tryIt: (text) => {
    say(text);
    byId("command").scrollIntoView({ block: "center" });
  },
});

const THEMES = ["auto", "light", "dark"];
byId("theme").addEventListener("click", () => {
  const next = THEMES[(THEMES.indexOf(document.documentElement.dataset.theme ?? "auto") + 1) % THEMES.length];
  document.documentElement.dataset.theme = next;
  byId("theme").textContent = `Theme: ${next}`;
});

const rank = (name) => (FIRST.includes(name) ? FIRST.indexOf(name) : FIRST.length);
async function begin() {
  const { items } = (await request("GET", "/environments?limit=200")).body;
  const names = items.map((item) => item.name).sort((one, two) => rank(one) - rank(two) || one.localeCompare(two));
  byId("world-name").replaceChildren(...names.map((name) => make("option", { value: name }, name)));
  const wanted = decodeURIComponent(location.hash.slice(1));
  byId("world-name").value = names.includes(wanted) ? wanted : names[0];
  await enter(byId("world-name").value);
  document.body.dataset.ready = "true";
}

/** Begin, with an API key where the service asks for one. */
async function admitted() {
  tell("command-problem");
  try {
    await begin();
    show(byId("key-form"), false);
  } catch (error) {
    show(byId("key-form"), error.slug === "unauthorized");
    refuse(error, "command-problem");
  }
}
byId("key-form").addEventListener("submit", (event) => {
  event.preventDefault();
  useKey(byId("key").value.trim());
  admitted();
});
await admitted();
