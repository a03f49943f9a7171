"""`palpate serve` as an object: a session and the gate of its robot (src/tool/README.md, "For callers in any language")."""

import json
import subprocess
import time

FREE_WITHIN_S = 10.0  # the session, of one whose driver was killed: it ends when it is asked no more


class Refused(Exception):
    """An answer that is not ok, in its words."""


class Gone(Exception):
    """The program ended: what it acknowledged is on the disk."""


class Serve:
    """Throws Refused where the program refuses what it is asked, Gone where it is not there any more."""

    def __init__(self, palpate, scene, folder, settings=(), anyway=False):
        self.process = subprocess.Popen([str(palpate), "serve", str(folder)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, start_new_session=True)
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
        try:
            self.process.stdin.write("".join(json.dumps(request) + "\n" for request in requests).encode())
            self.process.stdin.flush()
            lines = [self.process.stdout.readline() for _ in requests]
        except (OSError, ValueError) as error:
            raise Gone(f"palpate serve is gone: {error}") from error
        if not all(line.endswith(b"\n") for line in lines):
            raise Gone("palpate serve ended")
        answers = [json.loads(line) for line in lines]
        for answer in answers:
            if not answer["ok"]:
                raise Refused(answer["error"])
        return answers

    def ask(self, **request):
        return self.ask_all([request])[0]

    def close(self):
        self.process.stdin.close()
        self.process.stdout.close()
        return self.process.wait()
