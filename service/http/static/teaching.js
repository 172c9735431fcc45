// Teaching a task in place: one sentence, its query, its formula.

import { Problem, request, tellCurl } from "./api.js";
import { byId, make, tell } from "./dom.js";

const FIELDS = { "teach-text": "/examples", "teach-query": "/contextual_query", "teach-ltl": "/ltl" };

/** `environment()` names the world, `tryIt(text)` gives a command. */
export function prepareTeaching({ environment, tryIt }) {
  byId("teach").addEventListener("submit", async (event) => {
    event.preventDefault();
    forget();
    const text = byId("teach-text").value.trim();
    const body = {
      contextual_query: byId("teach-query").value.trim(),
      ltl: byId("teach-ltl").value.trim(),
      environment: environment(),
      examples: text ? [text] : [],
    };
    tellCurl(byId("teach-curl"), "POST", "/learn", body);
    try {
      const { status, body: template } = await request("POST", "/learn", body);
      const places = template.parameters.map((parameter) => `$${parameter.position}`).join(", ");
      byId("taught").replaceChildren(
        make("p", {}, make("strong", {}, status === 201 ? "Learned." : "Known already."), " ",
          make("code", {}, `${template.task}(${places})`), " becomes ", make("code", {}, template.template)),
        text ? make("button", { type: "button", onclick: () => tryIt(text) }, `Try “${text}”`) : "",
        ...template.warnings.map((warning) => make("p", { class: "note" }, warning)),
      );
    } catch (error) {
      if (!(error instanceof Problem)) throw error;
      refuse(error);
    }
  });
}

/** A refusal at the field that it is about. */
function refuse(problem) {
  for (const [field, pointer] of Object.entries(FIELDS)) {
    const said = problem.about(pointer);
    if (said === undefined) continue;
    tell(`${field}-problem`, problem.caret ? `${problem.message}\n${problem.caret}` : problem.message);
    byId(field).setAttribute("aria-invalid", "true");
    byId(field).focus();
    return;
  }
  tell("teach-problem", problem.message);
}

function forget() {
  byId("taught").replaceChildren();
  tell("teach-problem");
  for (const field of Object.keys(FIELDS)) {
    tell(`${field}-problem`);
    byId(field).removeAttribute("aria-invalid");
  }
}

/** Offer a lesson of the world. */
export function offer(lesson) {
  forget();
  byId("teach-curl").replaceChildren();
  byId("teach-text").value = lesson?.text ?? "";
  byId("teach-query").value = lesson?.contextual_query ?? "";
  byId("teach-ltl").value = lesson?.ltl ?? "";
}
