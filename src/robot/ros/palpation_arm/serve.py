"""`palpate serve` as an object: a session and the gate of its robot (src/tool/README.md, "For callers in any language")."""

import json
import os
import select
import subprocess
import time

FREE_WITHIN_S = 10.0  # the session, of one whose driver was killed: it ends when it is asked no more
# Until it answers, in the machine's time: an arm waits for the gate, and rests while a plan is made.
WITHIN_S = {"gate": 2.0, "acknowledge": 2.0, "open": 600.0, "next": 600.0, "conclude": 600.0}
OTHERS_WITHIN_S, ENDS_WITHIN_S = 20.0, 5.0
AT_ONCE = 200  # requests: their answers fit into a pipe, or both would wait for each other


class Refused(Exception):
    """An answer that is not ok, in its words."""


class Gone(Exception):
    """The program ended: what it acknowledged is on the disk."""


class Serve:
    """Throws Refused where the program refuses what it is asked, Gone where it is not there any more, or does not answer in time."""

    def __init__(self, palpate, scene, folder, settings=(), anyway=False):
        self.process = subprocess.Popen([str(palpate), "serve", str(folder)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, bufsize=0, start_new_session=True)
        self.heard = b""
        opening = {"do": "open", "scene": str(scene), "set": list(settings), "anyway": anyway}
        until = time.monotonic() + FREE_WITHIN_S
        while True:
            try:
                self.opened = self.ask(**opening)
                return
            except Refused as refused:
                if "is writing there" not in str(refused) or time.monotonic() > until:
                    self.close()
                    raise
                time.sleep(0.1)

    def ask_all(self, requests):
        """One answer for each, in order; those that came together are synced together."""
        answers = []
        for first in range(0, len(requests), AT_ONCE):
            some = requests[first : first + AT_ONCE]
            within_s = max(WITHIN_S.get(request["do"], OTHERS_WITHIN_S) for request in some)
            self.write("".join(json.dumps(request) + "\n" for request in some).encode())
            until = time.monotonic() + within_s
            answers += [json.loads(self.line(until, within_s)) for _ in some]
        for answer in answers:
            if not answer["ok"]:
                raise Refused(answer["error"])
        return answers

    def write(self, text):
        """What AT_ONCE requests are is less than a pipe and what is read at once hold."""
        try:
            while text:
                text = text[self.process.stdin.write(text) :]
        except (OSError, ValueError) as error:
            raise Gone(f"palpate serve is gone: {error}") from error

    def line(self, until, within_s):
        while b"\n" not in self.heard:
            left_s = max(0.0, until - time.monotonic())
            if not select.select([self.process.stdout], [], [], left_s)[0]:
                raise Gone(f"palpate serve does not answer within {within_s:g} s")
            some = os.read(self.process.stdout.fileno(), 1 << 16)
            if not some:
                raise Gone("palpate serve ended")
            self.heard += some
        line, self.heard = self.heard.split(b"\n", 1)
        return line

    def ask(self, **request):
        return self.ask_all([request])[0]

    def close(self):
        self.process.stdin.close()
        self.process.stdout.close()
        try:
            return self.process.wait(timeout=ENDS_WITHIN_S)
        except subprocess.TimeoutExpired:  # what it acknowledged is on the disk
            self.process.kill()
            return self.process.wait()
