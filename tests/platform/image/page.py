# SPDX-License-Identifier: Apache-2.0
"""Client of the page's HTTP interface, as a browser on another computer."""

import http.client
import json
import ssl


class Page:
    def __init__(self, port):
        self.port = port
        self.cookie = None

    def request(self, method, path, body=None):
        """Returns status and body. OSError: no connection."""
        # The appliance makes its certificate itself.
        context = ssl.create_default_context()
        context.check_hostname = False
        context.verify_mode = ssl.CERT_NONE
        connection = http.client.HTTPSConnection("127.0.0.1", self.port, timeout=60, context=context)
        headers = {"X-Orbwatch": "1"}
        if self.cookie:
            headers["Cookie"] = self.cookie
        if body is not None:
            headers["Content-Type"] = "application/json"
            body = json.dumps(body)
        try:
            connection.request(method, path, body, headers)
            answer = connection.getresponse()
            if answer.getheader("Set-Cookie"):
                self.cookie = answer.getheader("Set-Cookie").split(";")[0]
            return answer.status, answer.read()
        finally:
            connection.close()

    def set_first_password(self, code, password):
        return self.request("POST", "/api/v1/set_first_password", {"code": code, "password": password})

    def log_in(self, password):
        return self.request("POST", "/api/v1/login", {"user": "admin", "password": password})

    def picture(self, view):
        status, body = self.request("GET", f"/snapshot.jpg?view={view}")
        if status != 200 or not body.startswith(b"\xff\xd8"):
            raise ValueError(f"snapshot of {view}: {status} {body[:200]!r}")
        return body

    def status(self):
        return json.loads(self.request("GET", "/api/v1/status")[1])
