# SPDX-License-Identifier: Apache-2.0
"""A supply that is too weak: in the header of the page, the metrics and the status.

Folders: app/health app/ports/web/page/files app/ports/web/status
"""

import unittest
import urllib.request

from appliance import PATIENCE_S, Appliance, eventually
from page_case import PageCase


class SuppliedAppliance(Appliance):
    """Its kernel has the supply monitor of a Raspberry Pi, in a mount namespace of the daemon's own."""

    def __init__(self):
        super().__init__()
        self.monitor = self.folder / "class/hwmon/hwmon0"
        self.monitor.mkdir(parents=True)
        (self.monitor / "name").write_text("rpi_volt\n", encoding="utf-8")
        self.supply(is_low=False)

    def around(self):
        return ["unshare", "--map-root-user", "--mount", "sh", "-c",
                'mount --bind "$0" /sys/class && exec "$@"', self.folder / "class"]

    def supply(self, is_low):
        (self.monitor / "in0_lcrit_alarm").write_text(f"{int(is_low)}\n", encoding="utf-8")


class Power(PageCase):
    make_appliance = SuppliedAppliance

    def metric(self):
        with urllib.request.urlopen(f"{self.appliance.address}metrics", timeout=PATIENCE_S) as answer:
            lines = answer.read().decode().splitlines()
        [value] = [line.split()[1] for line in lines if line.startswith("orbwatch_health_throttling ")]
        return int(float(value))

    def test_header_names_under_voltage_while_it_lasts(self):
        self.addCleanup(self.appliance.supply, is_low=False)
        self.browser.get(self.appliance.address)
        eventually("the page shows the state", lambda: "running" in self.browser.text("#condition"))
        self.assertNotIn("voltage", self.browser.text("#notices"))
        self.appliance.supply(is_low=True)
        eventually("the header names it",
                   lambda: "voltage is too low" in self.browser.text("#notices"))
        self.assertEqual(self.appliance.status()["health"]["throttling"], 0x11)
        self.assertEqual(self.metric(), 0x11)
        self.appliance.supply(is_low=False)
        eventually("the header is quiet", lambda: "voltage" not in self.browser.text("#notices"))
        self.assertEqual(self.metric(), 0x10)


if __name__ == "__main__":
    unittest.main()
