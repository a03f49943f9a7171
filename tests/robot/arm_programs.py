"""The programs of an arm over a ROS 1 master of their own, as processes that are started, killed and started again."""

import os
import pathlib
import socket
import subprocess
import sys
import time

PATIENCE_S = 120


def wait_until(is_so, patience_s=PATIENCE_S):
    until = time.monotonic() + patience_s
    while not is_so() and time.monotonic() < until:
        time.sleep(0.002)
    return is_so()


class Programs:
    """`folder`: with scene.json and the run `world` (arm_scene.world_of), and for logs."""

    def __init__(self, palpate, root, folder, speed):
        self.palpate, self.ros, self.folder, self.speed = palpate, pathlib.Path(root) / "src" / "robot" / "ros", pathlib.Path(folder), speed
        with socket.socket() as spare:
            spare.bind(("localhost", 0))
            self.port = spare.getsockname()[1]
        self.environment = {"ROS_MASTER_URI": f"http://localhost:{self.port}", "ROS_HOSTNAME": "localhost", "ROS_LOG_DIR": str(folder), "ROS_VERSION": "1",
                            "PYTHONDONTWRITEBYTECODE": "1"}
        os.environ.update(self.environment)
        self.started = []

    def start(self, *words, stdout=subprocess.DEVNULL):
        self.started.append(subprocess.Popen([str(word) for word in words], stdout=stdout, stderr=subprocess.STDOUT, text=True))
        return self.started[-1]

    def answers(self):
        with socket.socket() as one:
            return one.connect_ex(("localhost", self.port)) == 0

    def master(self):
        process = self.start("rosmaster", "--core", "-p", self.port)
        assert wait_until(self.answers), "the master does not come up"
        return process

    def arm(self, *words):
        process = self.start(sys.executable, self.ros / "palpate-simulated-arm", "--tissue", self.folder / "world", "--speed", self.speed, *words, stdout=subprocess.PIPE)
        assert process.stdout.readline() == "PSM1 is there\n"
        return process

    def driver(self, session, *words):
        return self.start(sys.executable, self.ros / "palpate-arm", self.folder / "scene.json", session, "--palpate", self.palpate, "--yes", *words, stdout=subprocess.PIPE)

    def end(self, *processes):
        for process in processes or self.started:
            if process.poll() is None:
                process.kill()
            process.wait()
            if process.stdout:
                process.stdout.close()
        self.started = [process for process in self.started if process.returncode is None]
