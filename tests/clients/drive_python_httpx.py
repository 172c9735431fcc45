"""Drives a server with openapi-python-client's client: SERVER as the argument, the client on the path."""

import sys
import time

from cqltl_httpx_client import Client
from cqltl_httpx_client import models as m
from cqltl_httpx_client.api.environments import create_environment, get_environment
from cqltl_httpx_client.api.jobs import get_job
from cqltl_httpx_client.api.language import ground, learn, translate
from cqltl_httpx_client.api.planning import plan
from cqltl_httpx_client.api.policies import step_policy

TINY = m.ExplicitSpec(
    kind="explicit",
    name="generated-httpx",
    states=2,
    labels=m.ExplicitSpecLabels.from_dict({"goal": [1]}),
    transitions=[m.TransitionSpec(from_=0, action="go", to=[[1, 0.9], [0, 0.1]])],
)


def main(server: str) -> None:
    with Client(base_url=server, timeout=120) as client:
        said = translate.sync(client=client, body=m.TranslateRequest(text="Pickup the sphere", environment="toys"))
        assert (said.outcome, said.ltl) == ("translated", "F holding(sphere)"), said

        lesson = m.LearnRequest(
            contextual_query="grasp2(sphere)",
            ltl="F holding(sphere)",
            environment="toys",
            examples=["grasp number two, the sphere"],
        )
        assert learn.sync(client=client, body=lesson).template == "F holding($1)"
        query = m.GroundRequest(contextual_query="grasp2(cylinder)", environment="toys")
        assert ground.sync(client=client, body=query).ltl == "F holding(cylinder)"

        body = m.PlanRequest(text="Pickup the sphere", environment="toys-4x1-sphere")
        found = plan.sync(client=client, body=body, prefer="wait=60")
        assert isinstance(found, m.PlanResponse), found
        assert found.outcome == "solved"
        memory = found.initial.memory
        for place in found.trajectory:
            body = m.StepRequest(state=place.state, memory=memory)
            step = step_policy.sync(found.policy.id, client=client, body=body)
            memory = step.memory
        assert step.done

        create_environment.sync(client=client, body=TINY)
        kept = get_environment.sync("generated-httpx", client=client).spec
        assert kept.transitions[0].to == [[1, 0.9], [0, 0.1]], kept

        body = m.PlanRequest(ltl="F goal", environment="generated-httpx")
        job = plan.sync(client=client, body=body, prefer="respond-async")
        assert isinstance(job, m.JobOut), job
        while job.state in ("queued", "running"):
            time.sleep(0.05)
            job = get_job.sync(job.id, client=client)
        assert abs(job.plan.expected_steps - 1 / 0.9) < 1e-5

        refusal = ground.sync(client=client, body=m.GroundRequest(contextual_query="nonsense(x)", environment="toys"))
        assert isinstance(refusal, m.Problem)
        assert refusal.type_ == "urn:cqltl:problem:unknown-template"


main(sys.argv[1])
print("done")
