// Requests to the API, its problems as errors, and every request as the curl command that does the same.

import { make } from "./dom.js";

/** A refusal (RFC 9457): `slug`, `message` and the places in the request, JSON pointers, that it is about. */
export class Problem extends Error {
  constructor(body) {
    super(body.detail ?? "the service did not answer as expected");
    this.slug = (body.type ?? "").split(":").pop();
    this.errors = body.errors ?? [];
    this.caret = body.caret;
  }

  /** What is said about a place, if anything. */
  about(pointer) {
    return this.errors.find((error) => error.pointer.startsWith(pointer))?.detail;
  }
}

/** Status and body; JSON where it is JSON. Throws `Problem`. */
export async function request(method, path, body, { headers = {}, signal } = {}) {
  const options = { method, headers: { ...headers }, signal };
  if (body !== undefined) {
    options.headers["Content-Type"] = "application/json";
    options.body = JSON.stringify(body);
  }
  let response;
  try {
    response = await fetch(path, options);
  } catch (error) {
    if (error.name === "AbortError") throw error;
    throw new Problem({ detail: "the service cannot be reached; is it still running?" });
  }
  const json = /json/.test(response.headers.get("content-type") ?? "");
  const found = json ? await response.json() : await response.text();
  if (!response.ok) throw new Problem(json ? found : { detail: found });
  return { status: response.status, body: found };
}

const quoted = (text) => `'${text.replaceAll("'", "'\\''")}'`;

/** The curl command (7.82 or newer) of a request. */
export function curl(method, path, body, headers = {}) {
  const parts = ["curl"];
  for (const [name, value] of Object.entries(headers)) parts.push(`--header ${quoted(`${name}: ${value}`)}`);
  if (body !== undefined) parts.push(`--json ${quoted(JSON.stringify(body))}`);
  if (!(method === "GET" || (method === "POST" && body !== undefined))) parts.push(`--request ${method}`);
  parts.push(quoted(location.origin + path));
  return parts.join(" \\\n  ");
}

/** A disclosure with the curl command of a request, to be copied. */
export function curlBlock(method, path, body, headers) {
  const text = curl(method, path, body, headers);
  const copy = make("button", { type: "button", class: "copy" }, "Copy");
  copy.addEventListener("click", async () => {
    await navigator.clipboard.writeText(text);
    copy.textContent = "Copied";
    setTimeout(() => (copy.textContent = "Copy"), 1500);
  });
  const code = make("pre", { tabindex: "0", "aria-label": `curl command for ${method} ${path}` }, make("code", {}, text));
  return make("details", { class: "curl" }, make("summary", {}, "curl", make("span", { class: "unseen" }, ` for ${path}`)), code, copy);
}

/** Put the curl command of a request into its place. */
export function tellCurl(place, ...sent) {
  place.replaceChildren(curlBlock(...sent));
}
