// The drawn automaton, with the state lit in which the policy's memory is.

import { Problem, request, tellCurl } from "./api.js";
import { byId, picture, show } from "./dom.js";

/** Draw the automaton of a policy; too large a one is said to be so. */
export async function showAutomaton(url) {
  const path = `${url}/automaton?format=svg`;
  show(byId("automaton-empty"), false);
  tellCurl(byId("automaton-curl"), "GET", path);
  try {
    const svg = picture((await drawing(path)).body);
    byId("automaton").replaceChildren(svg);
    fit(svg);
  } catch (error) {
    if (!(error instanceof Problem)) throw error;
    byId("automaton").replaceChildren(document.createTextNode(error.message));
  }
}

/** The first drawing of a busy service may take too long; the second one finds all that it needs loaded. */
async function drawing(path) {
  try {
    return await request("GET", path);
  } catch (error) {
    if (error.slug !== "out-of-time") throw error;
    return await request("GET", path);
  }
}

/** Without the formula above it, which stands on the page, and as wide as its place, unless nobody could read it then. */
function fit(svg) {
  svg.querySelector(":scope > text.name")?.remove();
  const [ground] = svg.querySelectorAll(":scope > rect");
  ground?.remove();
  const { x, y, width, height } = svg.getBBox();
  svg.setAttribute("viewBox", `${x - 6} ${y - 6} ${width + 12} ${height + 12}`);
  svg.removeAttribute("width");
  svg.removeAttribute("height");
  svg.style.maxWidth = `${width + 12}px`;
  svg.style.minWidth = `${0.66 * width}px`;
  byId("automaton").tabIndex = byId("automaton").scrollWidth > byId("automaton").clientWidth ? 0 : -1;
}

/** Light the state after what is true now was read. */
export function light(memory, status) {
  for (const state of byId("automaton").querySelectorAll(".state")) {
    const now = state.dataset.state === String(memory);
    state.classList.toggle("current", now);
    if (now) {
      state.setAttribute("aria-current", "step");
      bring(state);
    } else state.removeAttribute("aria-current");
  }
  const words = { satisfied: ": done, whatever happens next", lost: ": it cannot be done any more", sustaining: ": the task holds as long as the policy goes on" };
  byId("memory").textContent = `State ${memory}${words[status] ?? ""}`;
}

/** Scroll the picture, and nothing else, so that a state is in the middle. */
function bring(state) {
  const frame = byId("automaton");
  const [outer, inner] = [frame.getBoundingClientRect(), state.getBoundingClientRect()];
  frame.scrollLeft += inner.left + inner.width / 2 - outer.left - outer.width / 2;
}

export function hideAutomaton() {
  byId("automaton").replaceChildren();
  byId("automaton-curl").replaceChildren();
  byId("memory").textContent = "";
  show(byId("automaton-empty"));
}
