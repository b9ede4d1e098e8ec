# SPDX-License-Identifier: Apache-2.0
"""A daemon with the simulated machine and its page on a port of its own."""

import contextlib
import http.client
import json
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import tempfile
import time
import urllib.request

ROOT = pathlib.Path(__file__).resolve().parents[2]
PATIENCE_S = 60  # limit on a busy machine; no wait normally takes so long
ALARM_S = 600  # limit for an alarm of the demo: once a minute or, on a busy machine, in more than two
# A domain of the test's own on the loopback interface.
LOOPBACK_DDS = (
    '<CycloneDDS><Domain><General><Interfaces><NetworkInterface name="lo"/></Interfaces>'
    "<AllowMulticast>false</AllowMulticast></General><Discovery>"
    f"<Tag>orbwatch_web_{os.getpid()}</Tag><ParticipantIndex>auto</ParticipantIndex>"
    "<MaxAutoParticipantIndex>32</MaxAutoParticipantIndex>"
    '<Peers><Peer address="127.0.0.1"/></Peers></Discovery></Domain></CycloneDDS>')


def eventually(what, condition, patience_s=PATIENCE_S):
    """Returns the result of `condition` as soon as it is true in Python's sense; polls a real
    program. `what`: text, or a function that states it at the time of the failure."""
    give_up = time.monotonic() + patience_s
    while not (value := condition()):
        if time.monotonic() > give_up:
            raise AssertionError(f"not within {patience_s} s: {what() if callable(what) else what}")
        time.sleep(0.05)
    return value


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Appliance:
    """Runs from start() to stop(), on the same port each time."""

    def __init__(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="orbwatch-web-"))
        self.port = free_port()
        for file in (ROOT / "platform/config").glob("demo*.toml"):
            shutil.copy(file, self.folder)
        # No ports that other daemons on this computer may have.
        site = (self.folder / "demo.toml").read_text(encoding="utf-8")
        for part, instead in (("[modbus]\nport = 1502\n", ""),
                              ("[web]\n", f"[web]\nport = {self.port}\n")):
            assert part in site, "the demo's site file has changed"
            site = site.replace(part, instead)
        site = 'state_folder = "state"\n' + site
        (self.folder / "demo.toml").write_text(site, encoding="utf-8")
        self.daemon = None

    def add_ball_view(self, side):
        """Adds the view "whole" of kind ball, of the colour camera alone, to the site."""
        with (self.folder / "demo.toml").open("a", encoding="utf-8") as site:
            site.write(f'''
[[view]]
name = "whole"
kind = "ball"
width = {side}
height = {side}
[[view.source]]
camera = "colour"
''')

    def environment(self):
        """Environment of the daemon, in addition to the test's own."""
        return {}

    def around(self):
        """Command that runs the daemon, as the words before it."""
        return []

    def unplug(self, *cameras):
        """Unplugs these simulated cameras after some frames; they stay so. Then the appliance may not be seen running
        without a fault: start() waits for an answer alone."""
        site = (self.folder / "demo.toml").read_text(encoding="utf-8")
        for camera in cameras:
            simulated = f'[camera.simulated]\nkind = "{camera}"\n'
            assert simulated in site, "the demo's site file has changed"
            fault = '[[camera.fault]]\nfault = "unplugged"\nfrom = 60\nuntil = 1000000000\n'
            site = site.replace(simulated, fault + simulated)
        (self.folder / "demo.toml").write_text(site, encoding="utf-8")
        self.runs = self.is_healthy

    def start(self, is_up=None):
        """Waits until `is_up`, by default runs(), which needs no log-in as long as there are no
        users."""
        log = open(self.folder / "log", "ab")
        self.daemon = subprocess.Popen(
            [*self.around(), ROOT / "build/release/app/orbwatchd", "--config", self.folder / "demo.toml"],
            stdout=log, stderr=log, env={**os.environ, "CYCLONEDDS_URI": "", **self.environment()})
        log.close()
        eventually("the daemon runs", is_up or self.runs)

    def says(self, condition):
        """Returns the condition; False as long as the daemon does not answer."""
        if self.daemon.poll() is not None:
            raise AssertionError((self.folder / "log").read_text(encoding="utf-8"))
        try:
            return condition()
        except OSError:
            return False

    def runs(self):
        return self.says(lambda: self.status()["system"]["state"] == 1)

    def is_healthy(self):
        def answers():
            with urllib.request.urlopen(self.address + "healthz", timeout=PATIENCE_S):
                return True
        return self.says(answers)

    def diagnosis(self):
        """End of the daemon's log, what each of its threads waits for, and its status. Never fails, so that the
        failure is reported that it belongs to."""
        log = self.folder / "log"
        if self.daemon is None or not log.exists():
            return "the daemon was not started"
        lines = log.read_text(encoding="utf-8", errors="replace").splitlines()
        threads = []
        for task in sorted(pathlib.Path(f"/proc/{self.daemon.pid}/task").glob("*")):
            with contextlib.suppress(OSError):  # the thread has ended
                name, waits = ((task / file).read_text().strip() for file in ("comm", "wchan"))
                threads.append(f"{name}: {waits}")
        try:
            status = self.status()["system"]
        except (OSError, ValueError, KeyError, http.client.HTTPException) as error:
            status = f"no status: {error}"
        return "\n".join([f"daemon's exit code: {self.daemon.poll()}", *lines[-20:], *threads, str(status)])

    def stop(self):
        """Fails when the daemon has ended by itself unnoticed, or ends with an error; nothing if it was seen to end."""
        if self.daemon.returncode is not None:
            return
        has_ended = self.daemon.poll() is not None
        self.daemon.send_signal(signal.SIGTERM)
        code = self.daemon.wait(PATIENCE_S)
        assert code == 0 and not has_ended, f"the daemon ended with {code}:\n{self.diagnosis()}"

    def close(self):
        self.stop()
        shutil.rmtree(self.folder)

    @property
    def address(self):
        return f"http://127.0.0.1:{self.port}/"

    def status(self):
        with urllib.request.urlopen(self.address + "api/v1/status", timeout=PATIENCE_S) as answer:
            return json.load(answer)
