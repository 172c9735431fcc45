"""Spans arrive at a collector where the standard variables name one."""

from __future__ import annotations

import gzip
import threading
from http.server import BaseHTTPRequestHandler, HTTPServer
from pathlib import Path

from benchmarks.server import serving


def test_spans_are_exported(tmp_path: Path) -> None:
    seen: dict[str, bytes] = {}

    class Collector(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            body = self.rfile.read(int(self.headers["content-length"]))
            packed = self.headers.get("content-encoding") == "gzip"
            seen[self.path] = seen.get(self.path, b"") + (gzip.decompress(body) if packed else body)
            self.send_response(200)
            self.end_headers()

        def log_message(self, *_arguments: object) -> None:
            """Nothing."""

    with HTTPServer(("127.0.0.1", 0), Collector) as collector:
        threading.Thread(target=collector.serve_forever, daemon=True).start()
        endpoint = f"http://127.0.0.1:{collector.server_port}"
        with serving(tmp_path, OTEL_EXPORTER_OTLP_ENDPOINT=endpoint, OTEL_BSP_SCHEDULE_DELAY="100") as client:
            assert client.get("/templates/ship").status_code == 200
            assert client.get("/livez").status_code == 200
            for _ in range(300):
                if b"/templates/{task}" in seen.get("/v1/traces", b""):
                    break
                threading.Event().wait(0.1)
        collector.shutdown()
    traces = seen["/v1/traces"]
    assert b"/templates/{task}" in traces
    assert b"service.name" in traces
    assert b"cqltl" in traces
    assert b"/livez" not in traces
