# SPDX-License-Identifier: Apache-2.0
"""Requests and bytes of loading the page, and what is not sent a second time.

Folders: app/ports/web/page app/ports/web/http app/ports/web/align
"""

import unittest

from appliance import eventually
from page_case import PageCase

MOST_REQUESTS = 15
MOST_BYTES = 100_000

# Notes the page's requests until the first picture of a view is drawn: the paths of calls of fetch(), which
# includes streams that are still open, and of each completed request its bytes on the wire, headers and body.
NOTE_THE_FIRST_PICTURE = """{
  const calls = [];
  const { fetch } = window;
  window.fetch = (...request) => (calls.push(String(request[0]).split("?")[0]), fetch(...request));
  new MutationObserver((_, observer) => {
    if (!document.querySelector('#tiles canvas[data-number]')) return;
    observer.disconnect();
    const completed = ['navigation', 'resource'].flatMap((kind) => performance.getEntriesByType(kind));
    window.untilTheFirstPicture = { calls, completed: completed.map(
      ({ name, initiatorType, transferSize, encodedBodySize }) => ({ path: new URL(name).pathname,
        isCall: initiatorType === 'fetch', sent: transferSize, size: encodedBodySize })) };
  }).observe(document, { subtree: true, childList: true, attributeFilter: ['data-number'] });
}"""


class Load(PageCase):
    def until_the_first_picture(self):
        """Paths of the calls of the interface, bytes of all requests, and the page's files by path."""
        noted = eventually("the first picture", lambda: self.browser.execute_script(
            "return window.untilTheFirstPicture"))
        files = {one["path"]: one for one in noted["completed"] if not one["isCall"]}
        return noted["calls"], sum(one["sent"] for one in noted["completed"]), files

    def test_the_first_picture_takes_few_requests_and_bytes(self):
        self.browser.execute_cdp_cmd(
            "Page.addScriptToEvaluateOnNewDocument", {"source": NOTE_THE_FIRST_PICTURE})
        self.browser.get(self.appliance.address)
        calls, sent, files = self.until_the_first_picture()
        print(f"first load: {len(calls)} calls and {len(files)} files, {sent} bytes, "
              f"{sum(file['sent'] for file in files.values())} of them of files")
        self.assertEqual(set(files) - {"/icon.svg"}, {"/", "/main.js", "/style.css"})
        self.assertTrue(all(file["sent"] >= file["size"] > 0 for file in files.values()), files)
        # The icon is loaded beside the page, and may not be listed.
        # The stream begins again once the views are known.
        once = [path for path in calls if path != "api/v1/live"]
        self.assertEqual(sorted(once), sorted(set(once)), "requested twice")
        self.assertLessEqual(len(calls) + len({*files, "/icon.svg"}), MOST_REQUESTS)
        self.assertLessEqual(sent, MOST_BYTES)

        self.browser.refresh()
        _, _, again = self.until_the_first_picture()
        for path in ("/main.js", "/style.css"):
            self.assertLess(again[path]["sent"], files[path]["size"], f"{path} was sent again")

    def test_an_unchanged_alignment_is_not_sent_again(self):
        self.browser.get(f"{self.appliance.address}#/align")

        def answers():
            return self.browser.execute_script("""
                return performance.getEntriesByType('resource')
                  .filter(({ name }) => name.endsWith('/api/v1/alignment'))
                  .map(({ transferSize, encodedBodySize }) => [transferSize, encodedBodySize]);""")

        sent, size = eventually("an answer", answers)[0]
        self.assertGreaterEqual(sent, size)
        eventually("an answer without a body", lambda: any(sent < size for sent, size in answers()))
        self.assertEqual(self.browser.complaints(), [])


if __name__ == "__main__":
    unittest.main()
