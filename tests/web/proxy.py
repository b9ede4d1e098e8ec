# SPDX-License-Identifier: Apache-2.0
"""Debian's nginx as a reverse proxy that ends TLS and shows an appliance below a path, configured
by the example of app/ports/web/PROXIES.md."""

import contextlib
import re
import socket
import ssl
import subprocess

from appliance import PATIENCE_S, ROOT, Appliance, eventually, free_port

PATH = "/cell4/orbwatch/"
CLIENT = "127.0.0.5"  # not a proxy
PAGE = ROOT / "app/ports/web/PROXIES.md"
# Main configuration of nginx, for the account that runs the tests; files in one folder.
MAIN = """
daemon off;
pid {folder}/pid;
error_log {folder}/error.log;
events {{}}
http {{
  access_log off;
  client_body_temp_path {folder}/body;
  proxy_temp_path {folder}/proxy;
  fastcgi_temp_path {folder}/fastcgi;
  uwsgi_temp_path {folder}/uwsgi;
  scgi_temp_path {folder}/scgi;
  {server}
}}
"""


def documented(language):
    """The example of the manual in that language."""
    return re.search(rf"^```{language}\n(.*?)^```", PAGE.read_text(encoding="utf-8"),
                     re.MULTILINE | re.DOTALL)[1]


def replaced(text, *changes):
    """Applies each change; a missing one would mean that the example differs from the tested
    text."""
    for before, after in changes:
        assert before in text, f"{PAGE}: {before} is not there any more"
        text = text.replace(before, after)
    return text


class Proxied(Appliance):
    """Runs behind nginx; both from start() to close()."""

    def __init__(self):
        super().__init__()
        self.https_port = free_port()
        self.nginx = None
        site = (self.folder / "demo.toml").read_text(encoding="utf-8")
        trusted = re.search(r"^trusted_proxies = .*$", documented("toml"), re.MULTILINE)[0]
        site = replaced(site, ("[web]", f'[web]\n{trusted}\nnames = ["plant.example"]'))
        (self.folder / "demo.toml").write_text(site, encoding="utf-8")
        self._make_certificate()
        self._configure()

    def _make_certificate(self):
        subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt",
                        "ec_paramgen_curve:P-256", "-nodes", "-days", "2", "-subj",
                        "/CN=plant.example", "-keyout", self.folder / "plant.key", "-out",
                        self.folder / "plant.pem"], check=True, capture_output=True)

    def _configure(self):
        server = replaced(
            documented("nginx"), ("listen 443 ssl", f"listen 127.0.0.1:{self.https_port} ssl"),
            ("/etc/ssl/plant.example.pem", str(self.folder / "plant.pem")),
            ("/etc/ssl/plant.example.key", str(self.folder / "plant.key")),
            ("127.0.0.1:8080", f"127.0.0.1:{self.port}"))
        assert f"location {PATH} {{" in server
        (self.folder / "nginx.conf").write_text(
            MAIN.format(folder=self.folder, server=server), encoding="utf-8")

    def start(self, is_up=None):
        super().start(is_up or self.is_healthy)
        if self.nginx is None:
            self.nginx = subprocess.Popen(["/usr/sbin/nginx", "-c", self.folder / "nginx.conf", "-e",
                                           self.folder / "error.log"])
        eventually("nginx listens", self._listens)

    def _listens(self):
        if self.nginx.poll() is not None:
            raise AssertionError((self.folder / "error.log").read_text(encoding="utf-8"))
        with socket.socket() as probe:
            return probe.connect_ex(("127.0.0.1", self.https_port)) == 0

    def close(self):
        if self.nginx:
            self.nginx.terminate()
            self.nginx.wait()
        super().close()

    @property
    def outside(self):
        """The page's address for browsers that find plant.example here."""
        return f"https://plant.example:{self.https_port}{PATH}"

    @contextlib.contextmanager
    def through(self, method, path, headers=(), body="", version="1.1"):
        """What nginx answers to a client of its own address for a path below the page's: the head's
        lines, and a file of what follows."""
        context = ssl._create_unverified_context()  # pylint: disable=protected-access
        plain = socket.create_connection(("127.0.0.1", self.https_port), PATIENCE_S, (CLIENT, 0))
        with context.wrap_socket(plain, server_hostname="plant.example") as connection:
            lines = [f"{method} {PATH}{path} HTTP/{version}",
                     f"Host: plant.example:{self.https_port}", "Content-Type: application/json",
                     f"Content-Length: {len(body)}", *headers, "", body]
            connection.sendall("\r\n".join(lines).encode())
            with connection.makefile("rb") as answer:
                yield list(iter(lambda: answer.readline().decode().rstrip(), "")), answer
