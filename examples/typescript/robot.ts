// Plans a command and drives its policy to the end, as a robot would. Node.js 18 or newer; no package but the compiler:
//
//     npx --package typescript@5 tsc --strict --target es2022 --module nodenext --outDir build robot.ts
//     node build/robot.js [SERVER]
//
// In place of a robot's sensors this takes the states of the expected run: nothing slips in the world toys-4x1-cylinder.

type State = Record<string, Record<string, string>>;

interface Plan {
  ltl: string;
  outcome: "solved" | "unsatisfiable" | "unreachable";
  probability: { lower: number; upper: number };
  initial: { memory: number };
  trajectory: { state: State; action: string | null }[];
  policy: { url: string } | null;
}

interface Job {
  state: "queued" | "running" | "succeeded" | "failed" | "cancelled";
  url: string;
  plan: Plan | null;
  error: Problem | null;
}

interface Step {
  action: string | null;
  memory: number;
  status: "running" | "sustaining" | "satisfied" | "lost";
}

interface Problem {
  type: string;
  detail: string;
}

class Refused extends Error {
  constructor(readonly problem: Problem) {
    super(`${problem.type}: ${problem.detail}`);
  }
}

declare const process: { argv: string[]; exitCode: number };

const server = process.argv[2] ?? "http://127.0.0.1:8000";
const sentence = "Put the cylinder in the box, then put the box in the bedroom";

async function ask<T>(method: "GET" | "POST", path: string, body?: unknown): Promise<T> {
  const response = await fetch(server + path, {
    method,
    headers: { "Content-Type": "application/json" },
    body: body === undefined ? undefined : JSON.stringify(body),
  });
  if (!response.ok) throw new Refused((await response.json()) as Problem);
  return (await response.json()) as T;
}

/** What takes longer than a request waits is a job: ask until it ends. */
async function plan(text: string, environment: string): Promise<Plan> {
  let answer = await ask<Plan | Job>("POST", "/plan", { text, environment });
  while ("state" in answer) {
    if (answer.plan !== null) return answer.plan;
    if (answer.error !== null) throw new Refused(answer.error);
    if (answer.state === "cancelled") throw new Error("somebody cancelled the plan");
    await new Promise((resolve) => setTimeout(resolve, 500));
    answer = await ask<Job>("GET", answer.url);
  }
  return answer;
}

async function main(): Promise<void> {
  const found = await plan(sentence, "toys-4x1-cylinder");
  if (found.policy === null) throw new Error(`there is no plan: ${found.outcome}`);
  console.log(`${found.ltl}: probability ${found.probability.lower}`);
  let memory = found.initial.memory;
  for (const { state } of found.trajectory) {
    const step = await ask<Step>("POST", `${found.policy.url}/step`, { state, memory });
    memory = step.memory;
    console.log(`${JSON.stringify(state)}  →  ${step.action ?? step.status}`);
    if (step.status === "satisfied") return;
  }
  throw new Error("the run ended before the task was done");
}

main().catch((error: Error) => {
  console.error(error.message);
  process.exitCode = 1;
});
