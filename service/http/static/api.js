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

let key = sessionStorage.getItem("cqltl-key") ?? ""; // an API key, for services that ask for one

/** Send an API key from now on, until the tab is closed. */
export function useKey(text) {
  key = text;
  sessionStorage.setItem("cqltl-key", key);
}

const allowed = (headers) => ({ ...headers, ...(key && { Authorization: `Bearer ${key}` }) });

/** Status and body; JSON where it is JSON. Throws `Problem`. */
export async function request(method, path, body, { headers = {}, signal } = {}) {
  const options = { method, headers: allowed(headers), signal };
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

/** The server-sent events of a stream, `{name, data}`; it is asked for again where it breaks off. */
export async function* events(path) {
  for (let failures = 0; ; failures++) {
    try {
      const response = await fetch(path, { headers: allowed({ Accept: "text/event-stream" }) });
      if (!response.ok) throw new Problem(await response.json());
      let text = "";
      const reader = response.body.pipeThrough(new TextDecoderStream()).getReader();
      for (let { done, value } = await reader.read(); !done; { done, value } = await reader.read()) {
        const messages = (text + value.replaceAll("\r", "")).split("\n\n");
        text = messages.pop();
        for (const message of messages) {
          const field = (name) => message.split("\n").find((line) => line.startsWith(`${name}: `))?.slice(name.length + 2);
          if (field("data") === undefined) continue;
          failures = 0;
          yield { name: field("event"), data: JSON.parse(field("data")) };
        }
      }
    } catch (error) {
      if (error instanceof Problem || failures >= 5) throw error instanceof Problem ? error : new Problem({ detail: "the service stopped telling how far the plan is" });
    }
    await new Promise((resolve) => setTimeout(resolve, 1000));
  }
}

const quoted = (text) => `'${text.replaceAll("'", "'\\''")}'`;

/** The curl command (7.82 or newer) of a request. */
export function curl(method, path, body, headers = {}) {
  const parts = ["curl"];
  if (key) parts.push('--header "Authorization: Bearer $CQLTL_API_KEY"');
  for (const [name, value] of Object.entries(headers)) parts.push(`--header ${quoted(`${name}: ${value}`)}`);
  if (body !== undefined) parts.push(`--json ${quoted(JSON.stringify(body))}`);
  if (!(method === "GET" || (method === "POST" && body !== undefined))) parts.push(`--request ${method}`);
  parts.push(quoted(location.origin + path));
  return parts.join(" \\\n  ");
}

/** A disclosure with the curl command of a request, to be copied. `aim` tells it from another one beside it. */
export function curlBlock({ aim }, method, path, body, headers) {
  const text = curl(method, path, body, headers);
  const copy = make("button", { type: "button", class: "copy" }, "Copy");
  copy.addEventListener("click", async () => {
    await navigator.clipboard.writeText(text);
    copy.textContent = "Copied";
    setTimeout(() => (copy.textContent = "Copy"), 1500);
  });
  const code = make("pre", { tabindex: "0", "aria-label": `curl command for ${method} ${path}` }, make("code", {}, text));
  return make("details", { class: "curl" }, make("summary", {}, aim ? `curl for ${aim}` : "curl", make("span", { class: "unseen" }, ` for ${path}`)), code, copy);
}

/** Put the curl command of a request into its place, whose `data-aim` says what it is for. */
export function tellCurl(place, ...sent) {
  place.replaceChildren(curlBlock(place.dataset, ...sent));
}
