# SPDX-License-Identifier: Apache-2.0
"""The files of the configuration, changed on the page of a running daemon.

Folders: app/ports/web/configuration app/files app/ports/web/page/files/system
"""

import json
import re
import signal
import unittest
import urllib.request

from selenium.webdriver.common.by import By

from appliance import Appliance, eventually
from page_case import PageCase

COMMENT = "# by hand: é, in its place\r\n"


class Configured(Appliance):
    """Service that can return to its configuration; its recipe has a comment and line ends of its
    own."""

    def __init__(self):
        super().__init__()
        self.recipe = self.folder / "demo-recipe.toml"
        text = self.recipe.read_bytes().replace(b"\n", b"\r\n")
        self.recipe.write_bytes(COMMENT.encode() + text)

        (self.folder / "state").mkdir()

    def environment(self):
        return {"STATE_DIRECTORY": str(self.folder / "state")}

    def configuration(self):
        with urllib.request.urlopen(self.address + "api/v1/configuration", timeout=60) as answer:
            return json.load(answer)

    def checksum(self):
        return self.status()["system"]["configuration_checksum"]


class ConfigurationPage(PageCase):
    @classmethod
    def make_appliance(cls):
        return Configured()

    def setUp(self):
        super().setUp()
        self.recipe = self.appliance.recipe.read_bytes()
        self.checksum = self.appliance.checksum()
        self.browser.get(f"{self.appliance.address}#/system")
        eventually("the part for the configuration", lambda: self.browser.find_elements(
            By.CSS_SELECTOR, "#configuration summary"))[0].click()
        eventually("its files", lambda: len(self.areas()) == 3)

    def areas(self):
        return {area.get_attribute("aria-label"): area
                for area in self.browser.find_elements(By.CSS_SELECTOR, "#configuration textarea")}

    def press(self, label):
        [button] = [one for one in self.browser.find_elements(
            By.CSS_SELECTOR, "#configuration button") if one.text == label]
        button.click()

    def press_twice(self, label, path):
        """Presses a button again before the answer to its request, which contains this path; there is one request."""
        self.browser.hold_answers(path)
        self.browser.execute_script("""
            const button = [...document.querySelectorAll('#configuration button')]
              .find(({ textContent }) => textContent === arguments[0]);
            button.click();
            button.click();""", label)
        self.assertEqual(len(self.browser.asked(path)), 1)
        self.browser.let_go()

    def type_into(self, name, old, new):
        """Types a text like a user, but at once."""
        self.browser.execute_script("""
            const area = [...document.querySelectorAll('#configuration textarea')]
              .find((one) => one.getAttribute('aria-label') === arguments[0]);
            area.closest('details').open = true;
            if (!area.value.includes(arguments[1])) throw new Error('there is no such text');
            area.value = area.value.replace(arguments[1], arguments[2]);
            area.dispatchEvent(new Event('input', { bubbles: true }));""", name, old, new)

    def said(self):
        return self.browser.text("#configuration [role=status]")

    def name_in_file(self):
        return re.search(r'^name = "(.*)"', self.recipe.decode(), re.MULTILINE)[1]

    def try_another_name(self, old, new):
        self.type_into("demo-recipe.toml", f'name = "{old}"', f'name = "{new}"')
        self.press_twice("Try out", "try_configuration")
        eventually("it runs", lambda: self.appliance.says(
            lambda: self.appliance.checksum() != self.checksum
            and self.appliance.configuration()["trial"]))
        eventually("the page says so",
                   lambda: "is reverted in" in self.browser.text("#configuration [role=timer]"))
        self.assertEqual(self.appliance.recipe.read_bytes(), self.recipe)

    def test_configuration_is_checked(self):
        self.type_into("demo-recipe.toml", "name = ", "nonsense ")
        self.press("Check and show the difference")
        eventually("the page says what is wrong and where",
                   lambda: "demo-recipe.toml:" in self.said())
        self.browser.keep_picture("configuration-wrong")
        # The browser complains about the 409 that answered the check.
        self.assertEqual([one for one in self.browser.complaints() if "409" not in one["message"]],
                         [])
        self.assertIsNone(self.appliance.configuration()["trial"])
        self.assertEqual(self.appliance.recipe.read_bytes(), self.recipe)

    def test_configuration_is_kept_byte_for_byte(self):
        self.try_another_name("cladding", "by_hand")
        self.browser.keep_picture("configuration")
        self.press_twice("Keep it", "confirm_configuration")
        eventually("the file is written",
                   lambda: self.appliance.recipe.read_bytes() != self.recipe)
        self.assertEqual(self.appliance.recipe.read_bytes(),
                         self.recipe.replace(b'name = "cladding"', b'name = "by_hand"', 1))
        eventually("nothing waits",
                   lambda: self.appliance.configuration()["trial"] is None)
        self.assertNotEqual(self.appliance.checksum(), self.checksum)
        self.assertNotIn("Refused", self.said())

    def test_configuration_of_a_second_editor_removes_no_change(self):
        self.type_into("demo-recipe.toml", "name = ", "# typed here\nname = ")
        by_hand = self.recipe + b"# by hand\r\n"
        self.addCleanup(self.appliance.recipe.write_bytes, self.recipe)
        self.appliance.recipe.write_bytes(by_hand)
        self.press("Try out")
        eventually("the page says who changed it and when",
                   lambda: "demo-recipe.toml was changed by" in self.said())
        self.browser.keep_picture("configuration-changed-elsewhere")
        self.assertIsNone(self.appliance.configuration()["trial"])
        eventually("the file is marked", lambda: "by another user" in self.browser.text(
            "#configuration details[open] summary"))
        self.press("Discard the change made here and show the present file")
        eventually("the other change is shown", lambda: self.areas()["demo-recipe.toml"]
                   .get_attribute("value").endswith("# by hand\n"))
        self.assertNotIn("typed here",
                         self.areas()["demo-recipe.toml"].get_attribute("value"))
        self.assertEqual(self.appliance.recipe.read_bytes(), by_hand)

    def part(self, line):
        """Part of both changes of a file that begins at this line of it."""
        return self.browser.find_element(
            By.XPATH, f"//*[@id='configuration']//fieldset[legend='From line {line}']")

    def chosen(self):
        return self.browser.execute_script("""
            return [...document.querySelectorAll('#configuration fieldset')]
              .map((part) => part.querySelector('input:checked')?.value ?? null);""")

    def test_configuration_of_two_editors_is_merged_by_parts(self):
        lines = self.recipe.decode().split("\r\n")
        name = next(n for n, line in enumerate(lines) if line.startswith("name = "))
        theirs, merged = [[*lines] for _ in range(2)]
        theirs[name] = 'name = "theirs"'
        theirs[-1] = "# theirs, at the end"
        self.type_into("demo-recipe.toml", "in its place", "in its own place")
        self.type_into("demo-recipe.toml", lines[name], 'name = "mine"')
        self.appliance.recipe.write_bytes("\r\n".join(theirs).encode())
        self.press("Try out")
        eventually("the page says who changed it and when",
                   lambda: "demo-recipe.toml was changed by" in self.said())
        eventually("what only one has changed is chosen", lambda: self.chosen() == ["mine", None, "theirs"])
        part = self.part(name + 1)
        self.assertEqual([one.text for one in part.find_elements(By.TAG_NAME, "pre")],
                         [lines[name], 'name = "theirs"', 'name = "mine"'])
        self.browser.keep_picture("configuration-merge")
        take = part.find_element(By.XPATH, "ancestor::section[@class='merge']//button")
        self.assertFalse(take.is_enabled())
        part.find_element(By.CSS_SELECTOR, "[value=mine]").click()
        take.click()
        self.assertEqual(self.browser.find_elements(By.CSS_SELECTOR, "#configuration .merge:not([hidden])"), [])
        self.press("Try out")
        eventually("it runs", lambda: self.appliance.says(
            lambda: self.appliance.checksum() != self.checksum and self.appliance.configuration()["trial"]))
        eventually("the page can end it", lambda: "is reverted in" in self.browser.text("#configuration [role=timer]"))
        self.press("Keep it")
        merged[0] = lines[0].replace("in its place", "in its own place")
        merged[name] = 'name = "mine"'
        merged[-1] = theirs[-1]
        eventually("the file has both changes", lambda: self.appliance.recipe.read_bytes().decode()
                   == "\r\n".join(merged))

    def test_configuration_that_is_uploaded_is_merged_with_a_change_on_the_board(self):
        lines = self.recipe.decode().split("\r\n")
        name = next(n for n, line in enumerate(lines) if line.startswith("name = "))
        uploaded, theirs = [*lines], [*lines]
        uploaded[name] = 'name = "uploaded"'
        theirs[-1] = "# theirs, beside an upload"
        file = self.appliance.folder / "uploaded" / "demo-recipe.toml"
        file.parent.mkdir()
        file.write_bytes("\r\n".join(uploaded).encode())
        self.browser.find_element(By.CSS_SELECTOR, "#configuration [type=file]").send_keys(str(file))
        eventually("its text", lambda: uploaded[name] in self.areas()["demo-recipe.toml"].get_attribute("value"))
        self.addCleanup(self.appliance.recipe.write_bytes, self.recipe)
        self.appliance.recipe.write_bytes("\r\n".join(theirs).encode())
        self.press("Try out")
        eventually("each change is chosen", lambda: self.chosen() == ["mine", "theirs"])
        self.browser.find_element(By.CSS_SELECTOR, "#configuration .merge:not([hidden]) > p > button").click()
        uploaded[-1] = theirs[-1]
        self.assertEqual(self.areas()["demo-recipe.toml"].get_attribute("value"), "\n".join(uploaded))
        self.press("Check and show the difference")
        difference = "#configuration pre[tabindex]"
        eventually("the difference", lambda: '+name = "uploaded"' in self.browser.text(difference))
        self.assertNotIn("+# theirs", self.browser.text(difference))

    def test_configuration_goes_back_when_asked(self):
        self.try_another_name(self.name_in_file(), "another")
        self.press("Revert now")
        eventually("the old one runs", lambda: self.appliance.says(
            lambda: self.appliance.checksum() == self.checksum))
        self.assertEqual(self.appliance.recipe.read_bytes(), self.recipe)

    def test_configuration_on_trial_is_ended_on_any_page(self):
        self.try_another_name(self.name_in_file(), "elsewhere")
        self.assertIn("started on the board", self.browser.text("#configuration [role=timer]"))
        self.browser.execute_script("location.hash = '#/live'")
        eventually("the header counts the seconds", lambda: re.search(
            r"reverted in \d+ s", self.browser.text("#trial [role=timer]")))
        # Outside of the notices: a screen reader would announce each second.
        self.assertNotIn("reverted in", self.browser.text("#notices"))
        self.assertIn("A configuration runs on trial", self.browser.text("#notices"))
        [revert] = [one for one in self.browser.find_elements(By.CSS_SELECTOR, "#trial button")
                    if one.text == "Revert now"]
        revert.click()
        eventually("the old one runs", lambda: self.appliance.says(
            lambda: self.appliance.checksum() == self.checksum))
        eventually("the header names no trial",
                   lambda: not self.browser.find_element(By.ID, "trial").is_displayed()
                   and "on trial" not in self.browser.text("#notices"))
        self.assertEqual(self.appliance.recipe.read_bytes(), self.recipe)

    def test_configuration_that_is_refused_is_named_on_all_pages(self):
        self.addCleanup(lambda: eventually("it is mended", lambda: self.appliance.says(
            lambda: not self.appliance.status()["system"]["configuration_refused"])))
        self.addCleanup(self.appliance.daemon.send_signal, signal.SIGHUP)
        self.addCleanup(self.appliance.recipe.write_bytes, self.recipe)
        self.browser.execute_script("location.hash = '#/live'")
        self.appliance.recipe.write_bytes(b"nonsense")
        self.appliance.daemon.send_signal(signal.SIGHUP)
        eventually("the header says so", lambda: "the last good one runs" in self.browser.text(
            "#notices a[href='#/system']"))

    def test_configuration_that_is_typed_is_not_lost_without_a_question(self):
        asks = """const event = new Event('beforeunload', { cancelable: true });
                  dispatchEvent(event);
                  return event.defaultPrevented;"""
        self.assertFalse(self.browser.execute_script(asks))
        self.type_into("demo-recipe.toml", "name = ", "# typed here\nname = ")
        self.assertTrue(self.browser.execute_script(asks))

    def test_configuration_that_is_typed_delays_the_page_of_another_version(self):
        self.type_into("demo-recipe.toml", "name = ", "# typed here\nname = ")
        self.browser.execute_script("window.isTheSamePage = true")
        self.browser.state_another_version()
        self.hide_for_a_while()
        eventually("the version was read", lambda: self.browser.execute_script("return window.versions") > 0)
        done = self.appliance.status()["system"]["frame_set"]
        eventually("more statuses", lambda: self.appliance.status()["system"]["frame_set"] > done + 15)
        self.assertTrue(self.browser.execute_script("return window.isTheSamePage"))
        self.type_into("demo-recipe.toml", "# typed here\nname = ", "name = ")
        eventually("a new page", lambda: not self.browser.execute_script("return window.isTheSamePage ?? false"))

    def test_configuration_that_was_sent_goes_back_by_itself(self):
        sent = self.appliance.folder / "sent" / "demo-recipe.toml"
        sent.parent.mkdir()
        sent.write_bytes(self.recipe.replace(b'name = "', b'name = "sent_', 1))
        self.browser.find_element(By.CSS_SELECTOR, "#configuration [type=file]").send_keys(str(sent))
        self.press("Check and show the difference")
        eventually("the difference", lambda: '+name = "sent_' in self.browser.text("#configuration pre"))
        seconds = self.browser.find_element(By.CSS_SELECTOR, "#configuration [name=seconds]")
        seconds.clear()
        seconds.send_keys("10")
        self.press("Try out")
        eventually("it runs", lambda: self.appliance.says(
            lambda: self.appliance.checksum() != self.checksum))
        eventually("the old one runs", lambda: self.appliance.says(
            lambda: self.appliance.checksum() == self.checksum))
        eventually("the page says so", lambda: "The configuration of the files runs" in self.said())
        self.assertEqual(self.appliance.recipe.read_bytes(), self.recipe)

    def test_configuration_keeps_nobody_out(self):
        self.browser.look_for_barriers()
        self.browser.refresh()
        eventually("the part for the configuration", lambda: self.browser.find_elements(
            By.CSS_SELECTOR, "#configuration summary"))[0].click()
        eventually("its files", lambda: len(self.areas()) == 3)
        self.browser.execute_script(
            "document.querySelectorAll('#configuration details').forEach((d) => { d.open = true; })")
        self.assertEqual(self.browser.barriers(), [])

    def test_configuration_fits_a_phone(self):
        self.browser.set_window_size(500, 844)
        self.browser.execute_script(
            "document.querySelectorAll('#configuration details').forEach((d) => { d.open = true; })")
        self.type_into("demo-recipe.toml", "# by hand", "# by another hand")
        self.press_twice("Check and show the difference", "check_configuration")
        eventually("the difference", lambda: "another" in self.browser.text("#configuration pre"))
        self.expect_fits_its_width()
        self.assertEqual(self.appliance.recipe.read_bytes(), self.recipe)


if __name__ == "__main__":
    unittest.main()
