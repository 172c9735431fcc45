// Making and finding elements. Text is always set as text, never as markup.

export const byId = (id) => document.getElementById(id);

/** An element with attributes, listeners (`onclick`) and children; null children are left out. */
export function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false && value != null) element.setAttribute(name, value);
  }
  element.append(...children.flat().filter((child) => child != null));
  return element;
}

export function show(element, shown = true) {
  element.hidden = !shown;
}

/** A message at the place that it concerns; an empty one is hidden. */
export function tell(id, text = "") {
  const place = byId(id);
  place.textContent = text;
  show(place, text !== "");
}

/** A name as people write it. */
export const shown = (name) => name.replaceAll("_", " ");

/** A picture that the server made, as an element. Its own style is left out: the page has one for both themes. */
export function picture(svg) {
  const plain = svg.replace(/<style>[\s\S]*?<\/style>/, "");
  const parsed = new DOMParser().parseFromString(plain, "image/svg+xml");
  return document.importNode(parsed.documentElement, true);
}

const reduced = matchMedia("(prefers-reduced-motion: reduce)");
export const still = () => reduced.matches;
