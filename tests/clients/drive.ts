// Drives a server with openapi-generator's TypeScript client: SERVER as the argument.
import {
  Configuration, EnvironmentsApi, JobsApi, LanguageApi, PlanningApi, PoliciesApi, ResponseError,
  type EnvironmentSpec, type JobOut, type Problem,
} from "./index";

declare const process: { argv: string[]; exit(status: number): never };

function check(holds: boolean, what: unknown): void {
  if (!holds) throw new Error(JSON.stringify(what));
}

const tiny: EnvironmentSpec = {
  kind: "explicit", name: "generated-typescript", states: 2, labels: { goal: [1] },
  transitions: [{ from: 0, action: "go", to: [[1, 0.9], [0, 0.1]] }],
};

async function main(server: string): Promise<void> {
  const configuration = new Configuration({ basePath: server });
  const language = new LanguageApi(configuration);
  const planning = new PlanningApi(configuration);

  const said = await language.translate({ translateRequest: { text: "Pickup the sphere", environment: "toys" } });
  check(said.outcome === "translated" && said.ltl === "F holding(sphere)", said);

  const template = await language.learn({
    learnRequest: {
      contextualQuery: "grasp3(sphere)", ltl: "F holding(sphere)", environment: "toys",
      examples: ["grasp number three, the sphere"],
    },
  });
  check(template.template === "F holding($1)", template);
  const grounded = await language.ground({
    groundRequest: { contextualQuery: "grasp3(cylinder)", environment: "toys" },
  });
  check(grounded.ltl === "F holding(cylinder)", grounded);

  const plan = await planning.plan({
    planRequest: { text: "Pickup the sphere", environment: "toys-4x1-sphere" }, prefer: "wait=60",
  });
  if ("state" in plan) throw new Error("within the wait it is no job");
  check(plan.outcome === "solved" && plan.policy !== null, plan);
  const policies = new PoliciesApi(configuration);
  let memory = plan.initial.memory;
  let done = false;
  for (const place of plan.trajectory) {
    const step = await policies.stepPolicy({
      policyId: plan.policy!.id, stepRequest: { state: place.state, memory },
    });
    memory = step.memory;
    done = step.done;
  }
  check(done, "the run does not end");

  const environments = new EnvironmentsApi(configuration);
  await environments.createEnvironment({ environmentSpec: tiny });
  const kept = (await environments.getEnvironment({ name: tiny.name })).spec;
  check(kept.kind === "explicit" && kept.transitions![0].to[0][1] === 0.9, kept);

  const accepted = await planning.plan({
    planRequest: { ltl: "F goal", environment: tiny.name }, prefer: "respond-async",
  });
  if (!("state" in accepted)) throw new Error("what is asked for later is a job");
  let job: JobOut = accepted;
  while (job.state === "queued" || job.state === "running") {
    await new Promise((resolve) => setTimeout(resolve, 50));
    job = await new JobsApi(configuration).getJob({ jobId: job.id });
  }
  check(Math.abs(job.plan!.expectedSteps! - 1 / 0.9) < 1e-5, job);

  try {
    await language.ground({ groundRequest: { contextualQuery: "nonsense(x)", environment: "toys" } });
    check(false, "a refusal was not thrown");
  } catch (error) {
    if (!(error instanceof ResponseError)) throw error;
    const problem: Problem = await error.response.json();
    check(problem.type === "urn:cqltl:problem:unknown-template", problem);
  }
  console.log("done");
}

main(process.argv[2]).catch((error) => { console.error(error); process.exit(1); });
