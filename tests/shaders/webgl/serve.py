#!/usr/bin/env python3
"""Runs kernels by WebGL 2 in a headless Chromium: served_route of route.hpp.

usage: serve.py SHADERS    SHADERS holds KERNEL.frag in ESSL 300

Says "ready DEVICE" or "unavailable WHY" on a line of its own, then answers each line "KERNEL INPUTS OUTPUTS IN OUT" with "done"
or "failed WHY". IN and OUT are files of floats.
"""
import json
import queue
import shutil
import subprocess
import sys
import tempfile
import threading
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

SHADERS = Path(sys.argv[1])
PAGE = Path(__file__).with_name("page.html")
# SwiftShader by way of ANGLE, which translates ESSL to SPIR-V. A kernel may take longer than the watchdog of a GPU grants.
FLAGS = ["--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-gpu-watchdog"]
STARTS_WITHIN, RUNS_WITHIN = 60, 600 # seconds

jobs, answers = queue.Queue(), queue.Queue()
current = {}


class Handler(BaseHTTPRequestHandler):
    def do_GET(self):
        if self.path == "/":
            self.reply(PAGE.read_bytes(), "text/html")
        elif self.path == "/job":
            current.update(jobs.get())
            text = (SHADERS / f"{current['kernel']}.frag").read_text()
            self.reply(json.dumps({"shader": text, "inputs": current["inputs"], "outputs": current["outputs"]}).encode())
        elif self.path == "/in":
            self.reply(Path(current["from"]).read_bytes())
        else:
            self.send_error(404)

    def do_POST(self):
        body = self.rfile.read(int(self.headers["Content-Length"]))
        if self.path == "/out":
            Path(current["to"]).write_bytes(body)
            answers.put("done")
        else: # ready, failed
            answers.put(f"{self.path[1:]} {' '.join(body.decode().split())}")
        self.reply(b"")

    def reply(self, body, kind="application/octet-stream"):
        self.send_response(200)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, *_):
        pass


def say(text):
    print(text, flush=True)


def main():
    chromium = shutil.which("chromium") or shutil.which("google-chrome")
    if not chromium:
        return say("unavailable no Chromium (chromium)")
    server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    server.daemon_threads = True
    threading.Thread(target=server.serve_forever, daemon=True).start()
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        browser = subprocess.Popen([chromium, *FLAGS, f"--user-data-dir={profile}", f"http://127.0.0.1:{server.server_port}/"],
                                   stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            say(answers.get(timeout=STARTS_WITHIN).replace("failed", "unavailable"))
            for line in sys.stdin:
                kernel, inputs, outputs, source, target = line.split()
                jobs.put({"kernel": kernel, "inputs": int(inputs), "outputs": int(outputs), "from": source, "to": target})
                say(answers.get(timeout=RUNS_WITHIN))
        except queue.Empty:
            say("unavailable Chromium does not answer")
        finally:
            browser.terminate()
            browser.wait()


main()
