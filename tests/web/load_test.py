# SPDX-License-Identifier: Apache-2.0
"""Requests and bytes of loading the page, and what is not sent a second time.

Folders: app/ports/web/page app/ports/web/http app/ports/web/align
"""

import unittest

from appliance import eventually
from page_case import PageCase

MOST_REQUESTS = 15
MOST_BYTES = 100_000

# Notes every request of the page, with its headers' and body's bytes on the wire, until the first picture of
# a view is drawn. A stream that is still open has no entry among the browser's measurements, so calls of
# fetch() are counted as they are made.
NOTE_THE_FIRST_PICTURE = """{
  let calls = 0;
  const { fetch } = window;
  window.fetch = (...request) => (++calls, fetch(...request));
  new MutationObserver((_, observer) => {
    if (!document.querySelector('#tiles canvas[data-number]')) return;
    observer.disconnect();
    const files = ['navigation', 'resource'].flatMap((kind) => performance.getEntriesByType(kind))
      .filter(({ initiatorType }) => initiatorType !== 'fetch');
    window.untilTheFirstPicture = { calls, files: files.map(({ name, transferSize, encodedBodySize }) =>
      ({ name: new URL(name).pathname, sent: transferSize, size: encodedBodySize })) };
  }).observe(document, { subtree: true, childList: true, attributeFilter: ['data-number'] });
}"""


class Load(PageCase):
    def until_the_first_picture(self):
        """Number of calls of the interface, and by path the page's files: bytes sent, bytes of the file."""
        noted = eventually("the first picture", lambda: self.browser.execute_script(
            "return window.untilTheFirstPicture"))
        return noted["calls"], {file["name"]: (file["sent"], file["size"]) for file in noted["files"]}

    def test_the_first_picture_takes_few_requests_and_bytes(self):
        self.browser.execute_cdp_cmd(
            "Page.addScriptToEvaluateOnNewDocument", {"source": NOTE_THE_FIRST_PICTURE})
        self.browser.get(self.appliance.address)
        calls, files = self.until_the_first_picture()
        print(f"first load: {calls} calls, {files}")
        self.assertEqual(set(files) - {"/icon.svg"}, {"/", "/main.js", "/style.css"})
        # The icon is loaded beside the page, and may not be listed.
        self.assertLessEqual(calls + len({*files, "/icon.svg"}), MOST_REQUESTS)
        self.assertLessEqual(sum(sent for sent, _ in files.values()), MOST_BYTES)
        self.assertTrue(all(sent >= size > 0 for sent, size in files.values()), files)

        self.browser.refresh()
        _, again = self.until_the_first_picture()
        for name in ("/main.js", "/style.css"):
            self.assertLess(again[name][0], files[name][1], f"{name} was sent again")

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
