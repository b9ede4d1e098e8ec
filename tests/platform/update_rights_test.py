#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Rights of an image's users on RAUC's service, by a bus with Debian's policy and ours. Exit 77: root, dbus-daemon,
dbus-send or python3-gi is missing."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
POLICY = ROOT / "platform/image/system/etc/dbus-1/system.d/orbwatch-update.conf"
SKIPPED = 77
SERVICE_USER, OTHER_USER = "daemon", "nobody"  # the former in place of orbwatch
INSTALLER, PROPERTIES = "de.pengutronix.rauc.Installer", "org.freedesktop.DBus.Properties"

# The system bus of Debian, and the policy of its package rauc: every user may do everything.
BUS = """<!DOCTYPE busconfig PUBLIC "-//freedesktop//DTD D-BUS Bus Configuration 1.0//EN"
 "http://www.freedesktop.org/standards/dbus/1.0/busconfig.dtd">
<busconfig>
  <type>system</type><listen>unix:path={folder}/bus</listen><auth>EXTERNAL</auth>
  <policy context="default">
    <allow user="*"/><deny own="*"/><deny send_type="method_call"/><allow send_type="signal"/>
    <allow send_requested_reply="true" send_type="method_return"/>
    <allow send_requested_reply="true" send_type="error"/>
    <allow receive_type="method_call"/><allow receive_type="method_return"/>
    <allow receive_type="error"/><allow receive_type="signal"/>
    <allow send_destination="org.freedesktop.DBus"/>
  </policy>
  <policy context="default"><allow send_destination="de.pengutronix.rauc"/></policy>
  <policy user="root"><allow own="de.pengutronix.rauc"/></policy>
  <include>{folder}/ours.conf</include>
</busconfig>
"""

SERVICE = """
from gi.repository import Gio, GLib
METHODS = ("Info", "InstallBundle", "Install", "Mark")
node = "".join(f'<method name="{name}"><arg type="s" direction="in"/></method>' for name in METHODS)
node = ('<node><interface name="de.pengutronix.rauc.Installer">' + node +
        '<property name="Compatible" type="s" access="read"/></interface></node>')
bus = Gio.bus_get_sync(Gio.BusType.SYSTEM)
bus.register_object("/", Gio.DBusNodeInfo.new_for_xml(node).interfaces[0],
                    lambda *call: call[-1].return_value(None), lambda *get: GLib.Variant("s", "kind"), None)
Gio.bus_own_name_on_connection(bus, "de.pengutronix.rauc", 0, lambda *_: print("owned", flush=True), None)
GLib.MainLoop().run()
"""


class UpdateRights(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="orbwatch-bus-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.folder.chmod(0o755)
        ours = POLICY.read_text(encoding="utf-8")
        assert 'user="orbwatch"' in ours
        (cls.folder / "ours.conf").write_text(ours.replace('"orbwatch"', f'"{SERVICE_USER}"'), encoding="utf-8")
        (cls.folder / "bus.conf").write_text(BUS.format(folder=folder.name), encoding="utf-8")
        cls.environment = {**os.environ, "DBUS_SYSTEM_BUS_ADDRESS": f"unix:path={folder.name}/bus"}
        cls.start(["dbus-daemon", "--nofork", "--print-address", f"--config-file={folder.name}/bus.conf"])
        cls.start([sys.executable, "-c", SERVICE])

    @classmethod
    def start(cls, command):
        """Returns when the program has printed its first line."""
        program = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, env=cls.environment)
        cls.addClassCleanup(program.stdout.close)
        cls.addClassCleanup(program.wait)
        cls.addClassCleanup(program.kill)
        assert program.stdout.readline(), command

    def may(self, user, interface, member, *arguments):
        call = subprocess.run(
            ["setpriv", "--reuid", user, "--clear-groups", "dbus-send", "--system", "--print-reply",
             "--dest=de.pengutronix.rauc", "/", f"{interface}.{member}", *[f"string:{one}" for one in arguments]],
            capture_output=True, text=True, check=False, env=self.environment)
        if call.returncode != 0:
            self.assertIn("AccessDenied", call.stderr)
        return call.returncode == 0

    def allowed(self, user):
        methods = [name for name in ("Info", "InstallBundle", "Install", "Mark")
                   if self.may(user, INSTALLER, name, "x")]
        return methods + ["Get"] * self.may(user, PROPERTIES, "Get", INSTALLER, "Compatible")

    def test_service_may_check_and_install_only(self):
        self.assertEqual(self.allowed(SERVICE_USER), ["Info", "InstallBundle", "Get"])

    def test_root_may_do_everything(self):
        self.assertEqual(self.allowed("root"), ["Info", "InstallBundle", "Install", "Mark", "Get"])

    def test_other_users_may_do_nothing(self):
        self.assertEqual(self.allowed(OTHER_USER), [])


def is_possible():
    has_gi = subprocess.run([sys.executable, "-c", "import gi"], stderr=subprocess.DEVNULL, check=False).returncode == 0
    return has_gi and os.geteuid() == 0 and all(map(shutil.which, ("dbus-daemon", "dbus-send", "setpriv")))


if __name__ == "__main__":
    if not is_possible():
        sys.exit(SKIPPED)
    unittest.main()
