// The steps from a sentence to a formula, with what each request said.

import { curlBlock, request } from "./api.js";
import { byId, make, show, shown } from "./dom.js";

/** Show a translation; `asked` is the body that was sent. */
export async function showUnderstanding(translation, asked) {
  const query = translation.contextual_query;
  show(byId("understood-empty"), false);
  show(byId("steps"), true);
  byId("confidence").textContent =
    translation.confidence == null ? "" : `${(100 * translation.confidence).toFixed(1)} % sure`;
  const steps = [
    row("Sentence", marked(translation.text, translation.bindings), bound(translation), ["POST", "/translate", asked]),
    row("Query", code(query?.text ?? (translation.question ? "not complete" : "no task fits")), others(translation), ["POST", "/translate", asked]),
  ];
  byId("steps").replaceChildren(...steps);
  if (!query) return;
  const templates = await learned(query);
  const first = tasksOf(query)[0];
  steps.push(row("Template", templates.map(templateLine), null, ["GET", `/templates/${first}`]));
  if (translation.ltl) {
    const grounding = { contextual_query: query.text, environment: asked.environment, ...(asked.state && { state: asked.state }) };
    steps.push(row("Formula", code(translation.ltl), notes(translation.warnings), ["POST", "/ground", grounding]));
    const asks = { ltl: translation.ltl, environment: asked.environment };
    const said = (await request("POST", "/explain", asks)).body;
    const kind = said.kind && `The task ${said.kind.explanation}.`;
    steps.push(row("In English", make("p", { class: "reading" }, sentence(translation.explanation)), kind && make("p", { class: "note" }, kind), ["POST", "/explain", asks]));
  } else if (translation.issues.length) {
    steps.push(row("Formula", make("p", { class: "note" }, translation.issues.map((issue) => issue.detail).join("; ")), null, null));
  }
  byId("steps").replaceChildren(...steps);
}

export function hideUnderstanding() {
  show(byId("steps"), false);
  show(byId("understood-empty"), true);
  byId("confidence").textContent = "";
}

function row(label, content, extra, sent) {
  return make("li", {}, make("h3", {}, label), make("div", { class: "content" }, content, extra ?? null), sent ? curlBlock({}, ...sent) : null);
}

const code = (text) => make("code", { class: "formula" }, text);
const sentence = (text) => (text ? text[0].toUpperCase() + text.slice(1) + "." : "");

/** The sentence with the phrases marked that the arguments are, numbered. */
function marked(text, bindings) {
  const found = [];
  bindings.forEach(({ phrase }, index) => {
    const literal = phrase.replace(/[.*+?^${}()|[\]\\]/g, "\\$&");
    for (const match of text.matchAll(new RegExp(`(?<![\\p{L}\\p{N}])${literal}(?![\\p{L}\\p{N}])`, "giu"))) {
      const [start, end] = [match.index, match.index + match[0].length];
      if (!found.every((other) => start >= other.end || end <= other.start)) continue;
      found.push({ start, end, number: index + 1 });
      break;
    }
  });
  found.sort((one, two) => one.start - two.start);
  const parts = [];
  let last = 0;
  for (const { start, end, number } of found) {
    parts.push(text.slice(last, start), make("mark", { class: `m${(number - 1) % 6}` }, text.slice(start, end), make("sup", {}, number)));
    last = end;
  }
  return make("p", { class: "sentence" }, ...parts, text.slice(last));
}

/** What the marked phrases name. */
function bound(translation) {
  if (!translation.bindings.length) return null;
  return make("ul", { class: "bindings" }, translation.bindings.map((binding, index) => {
    const things = binding.things.map((thing) => shown(thing.name)).join(binding.quantifier === "any" ? " or " : " and ");
    return make("li", {}, make("span", { class: "number" }, index + 1), ` ${things} `, make("span", { class: "note" }, binding.reason));
  }));
}

/** The other readings, with their confidence. */
function others(translation) {
  const rest = translation.candidates.slice(1).filter((candidate) => candidate.contextual_query && candidate.confidence >= 0.01);
  if (!rest.length) return null;
  const text = rest.map((c) => `${c.contextual_query.text} (${(100 * c.confidence).toFixed(1)} %)`).join(", ");
  return make("p", { class: "note" }, `or, less likely: ${text}`);
}

const notes = (warnings) => (warnings.length ? make("p", { class: "note" }, warnings.join("; ")) : null);

/** The tasks of a query, each once. */
function tasksOf(query) {
  const found = query.task ? [query.task] : query.operands.flatMap(tasksOf);
  return [...new Set(found)];
}

async function learned(query) {
  return Promise.all(tasksOf(query).map(async (task) => (await request("GET", `/templates/${encodeURIComponent(task)}`)).body));
}

function templateLine(template) {
  const places = template.parameters.map((parameter) => `$${parameter.position}`).join(", ");
  return make("p", { class: "template" }, code(`${template.task}(${places})`), make("span", { class: "becomes" }, " becomes "), code(template.template));
}
