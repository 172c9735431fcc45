"""The yardstick of `benchmarks.load`: an endpoint of FastAPI that does nothing, served as the service is.

python -m benchmarks.empty
"""

from __future__ import annotations

import socket

import uvicorn
from fastapi import FastAPI

app = FastAPI()


@app.post("/empty")
async def post_empty() -> dict[str, bool]:
    """An answer of one member; the body is not read."""
    return {"done": True}


def main() -> None:
    """Serve on a free port and say which."""
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM, socket.IPPROTO_TCP) as listener:
        listener.bind(("127.0.0.1", 0))
        listener.listen(2048)
        print(f"serves http://127.0.0.1:{listener.getsockname()[1]}", flush=True)
        uvicorn.Server(uvicorn.Config(app, log_level="warning")).run(sockets=[listener])


if __name__ == "__main__":
    main()
