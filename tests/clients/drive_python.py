"""Drives a server with openapi-generator's Python client: SERVER as the argument, the client on the path."""

import sys
import time

import cqltl_client as c

TINY = {
    "kind": "explicit",
    "name": "generated-python",
    "states": 2,
    "labels": {"goal": [1]},
    "transitions": [{"from": 0, "action": "go", "to": [[1, 0.9], [0, 0.1]]}],
}


def main(server: str) -> None:
    with c.ApiClient(c.Configuration(host=server)) as client:
        language, planning, policies = c.LanguageApi(client), c.PlanningApi(client), c.PoliciesApi(client)
        environments, jobs = c.EnvironmentsApi(client), c.JobsApi(client)

        said = language.translate(c.TranslateRequest(text="Pickup the sphere", environment="toys"))
        assert (said.outcome, said.ltl) == ("translated", "F holding(sphere)"), said

        lesson = c.LearnRequest(
            contextual_query="grasp1(sphere)",
            ltl="F holding(sphere)",
            environment="toys",
            examples=["grasp number one, the sphere"],
        )
        assert language.learn(lesson).template == "F holding($1)"
        assert (
            language.ground(c.GroundRequest(contextual_query="grasp1(cylinder)", environment="toys")).ltl
            == "F holding(cylinder)"
        )

        plan = planning.plan(c.PlanRequest(text="Pickup the sphere", environment="toys-4x1-sphere"), prefer="wait=60")
        assert isinstance(plan, c.PlanResponse), plan
        assert plan.outcome == "solved"
        memory = plan.initial.memory
        for place in plan.trajectory:
            step = policies.step_policy(plan.policy.id, c.StepRequest(state=place.state, memory=memory))
            memory = step.memory
        assert step.done

        environments.create_environment(c.EnvironmentSpec.from_dict(TINY))
        kept = environments.get_environment("generated-python").spec.actual_instance
        assert isinstance(kept, c.ExplicitSpec), kept
        assert kept.transitions[0].to == [[1, 0.9], [0, 0.1]]

        job = planning.plan(c.PlanRequest(ltl="F goal", environment="generated-python"), prefer="respond-async")
        assert isinstance(job, c.JobOut), job
        while job.state in ("queued", "running"):
            time.sleep(0.05)
            job = jobs.get_job(job.id)
        assert job.plan.expected_steps is not None
        assert abs(job.plan.expected_steps - 1 / 0.9) < 1e-5

        refusal = None
        try:
            language.ground(c.GroundRequest(contextual_query="nonsense(x)", environment="toys"))
        except c.ApiException as error:
            refusal = error.data
        assert isinstance(refusal, c.Problem), refusal
        assert refusal.type == "urn:cqltl:problem:unknown-template"


main(sys.argv[1])
print("done")
