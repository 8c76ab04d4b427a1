#!/usr/bin/env python3
"""clients.py FOAM FOLDER SECONDS ROBOT…: slow and fast clients of the page of `foam view`, which edit and save.

FOAM is a program that was built with sanitizers. The first server ends without requests, the next three while they come. Exit
code 1 if a sanitizer reports anything, a server does not end, or it answers that something within foam is wrong.
"""
import collections
import http.client
import json
import os
import random
import re
import signal
import socket
import subprocess
import sys
import threading
import time

FORMATS = {"urdf": "urdf", "json": "json", "csv": "csv", "curobo": "yml", "xrdf": "xrdf", "srdf": "srdf", "mjcf": "xml", "recipe": "yaml"}
answers = collections.Counter()


class Page:
    def __init__(self, foam, folder, robots):
        environment = dict(os.environ, XDG_CACHE_HOME=os.path.join(folder, "cache"))
        self.told = os.path.join(folder, "told.txt")
        with open(self.told, "wb") as told:
            self.process = subprocess.Popen([foam, "view", "--no-open", "-j", "2", "-n", "20"] + robots, env=environment, cwd=folder, stderr=told,
                                            stdout=subprocess.PIPE, text=True)
        address = re.match(r"http://127.0.0.1:(\d+)/(\w+)/", self.process.stdout.readline())
        self.port, self.token = int(address[1]), address[2]

    def ask(self, what, body=None):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=300)
        if body is None:
            connection.request("GET", f"/{self.token}/{what}")
        else:
            headers = {"Content-Type": "application/json", "Origin": f"http://127.0.0.1:{self.port}"}
            connection.request("POST", f"/{self.token}/{what}", json.dumps(body), headers)
        answer = connection.getresponse()
        content = answer.read()
        connection.close()
        answers[what, answer.status] += 1
        return content

    def version(self):
        return json.loads(self.ask("ignored", {"model": 0}))["version"]

    def end(self, how):
        self.process.send_signal(how)
        for _ in range(1200):  # the thread sanitizer runs no handler before the next connection
            try:
                socket.create_connection(("127.0.0.1", self.port)).close()
            except OSError:
                pass
            if self.process.poll() is not None:
                return self.process.returncode
            time.sleep(0.1)
        self.process.kill()
        return "none"


def request(page, rng):
    """Returns what a page asks for, or changes."""
    change = {"version": page.version(), "model": 0, "link": rng.randrange(10), "index": rng.randrange(3), "pinned": True,
              "spheres": rng.randrange(8, 40), "sphere": [rng.random() / 10, 0, 0, rng.choice([0.05, -1, 1e5, 1e300])]}
    kind = rng.choice(["move", "add", "remove", "pin", "more", "fewer", "again", "close", "count"])
    saved = rng.choice(list(FORMATS))
    save = {"model": 0, "format": saved, "file": f"saved{rng.randrange(3)}.{FORMATS[saved]}", "replace": True}
    return rng.choice([("scene", None), ("meshes", None), ("view.js", None), ("proofs", {"model": rng.randrange(2)}), ("figures", {"model": 0}),
                       ("save", save), ("undo", change), ("redo", change), ("edit", {}), ("edit", dict(change, kind=kind)),
                       ("edit", dict(change, kind=kind)), ("edit", dict(change, kind=kind))])


def fast_client(page, seed, end):
    rng = random.Random(seed)
    while time.time() < end:
        try:
            page.ask(*request(page, rng))
        except (OSError, http.client.HTTPException, ValueError, KeyError):
            time.sleep(0.05)  # the server ends


def slow_client(page, seed, end):
    rng = random.Random(seed)
    get = f"GET /{page.token}/scene HTTP/1.1\r\nHost: 127.0.0.1:{page.port}\r\n\r\n".encode()
    post = get.replace(b"GET", b"POST").replace(b"scene", b"edit")[:-2]
    post += f"Origin: http://127.0.0.1:{page.port}\r\nContent-Type: application/json\r\nContent-Length: 1000\r\n\r\n{{".encode()
    while time.time() < end:
        try:
            with socket.create_connection(("127.0.0.1", page.port)) as client:
                for piece in rng.choice([[get[:20], get[20:40]], [get], [get * 5], [post], [rng.randbytes(2000), b"\r\n\r\n"], []]):
                    client.send(piece)
                    time.sleep(0.3)
        except OSError:
            time.sleep(0.05)


def is_well(page, code):
    with open(page.told, errors="replace") as told:
        text = told.read()
    well = code in (0, 130, -signal.SIGINT) and "Sanitizer" not in text and "runtime error" not in text
    print("ended with", code, "" if well else text, flush=True)
    return well


def served(foam, folder, robots, seconds, how, while_asked):
    page = Page(foam, folder, robots)
    for what, body in [("", None), ("scene", None), ("proofs", {"model": 0}), ("edit", {})]:
        page.ask(what, body)  # one after the other: what the server's library makes at its first request is not seen as a race
    end = time.time() + seconds + (5 if while_asked else 0)
    clients = [threading.Thread(target=fast_client, args=(page, seed, end)) for seed in range(6)]
    clients += [threading.Thread(target=slow_client, args=(page, seed, end)) for seed in range(4)]
    for client in clients:
        client.start()
    time.sleep(seconds)
    for client in clients if not while_asked else []:
        client.join()
    well = is_well(page, page.end(how))
    for client in clients:
        client.join()
    return well


def main(foam, folder, seconds, robots):
    os.makedirs(folder, exist_ok=True)
    robots = [os.path.abspath(robot) for robot in robots]
    rounds = [(float(seconds), signal.SIGINT, False), (8, signal.SIGTERM, True), (4, signal.SIGINT, True), (2, signal.SIGINT, True)]
    well = [served(os.path.abspath(foam), folder, robots, *round_) for round_ in rounds]
    print(dict(answers))
    return 0 if all(well) and not any(status == 500 for _, status in answers) else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:4], sys.argv[4:]))
