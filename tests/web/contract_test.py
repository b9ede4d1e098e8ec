# SPDX-License-Identifier: Apache-2.0
"""Every route of /api/v1/openapi.json, asked at a running daemon: the answers have the described
form, wrong arguments are refused by their names, and changes are in the audit.

Folders: app/ports/web
"""

import base64
import collections
import datetime
import http.client
import json
import unittest
import urllib.parse

import jsonschema

from appliance import LOOPBACK_DDS, PATIENCE_S, Appliance, eventually, free_port

PASSWORD, NEXT_PASSWORD = "correct horse battery", "another horse battery"
COMMAND = "/api/v1/command/"
UPLOADED_BYTES = 30000  # for a request: in Base64 less than max_body_bytes of [web]
# Changes that the audit leaves out, with the reason.
NOT_AUDITED = {"check_configuration": "changes nothing", "check_recipe": "changes nothing",
               "check_restore": "changes nothing",
               "machine_state": "a machine sends many a second"}
RESTARTING = {"restart", "accept_alignment", "revert_alignment", "restore"}
# The delivered configuration is missing without an installed package, and two slots without an image.
REFUSED = {"factory_reset": 409, "upload_update": 404, "install_update": 404, "restart_device": 404}

MORE_OF_THE_SITE = """
[[view]]
name = "ball"
kind = "ball"
width = 400
height = 400
[[view.source]]
camera = "colour"
[modbus]
address = "127.0.0.1"
port = {modbus_port}
[recorder]
folder = "recordings"
reserve_mib = 16
[recorder.events]
ring_mib = 64
before_s = 0.2
after_s = 0.2
longest_s = 1
on_alarm = false
"""

FORMATS = jsonschema.FormatChecker(formats=())


@FORMATS.checks("date-time", raises=ValueError)
def is_date_time(value):
    return not isinstance(value, str) or bool(datetime.datetime.fromisoformat(value))


class WholeAppliance(Appliance):
    """Appliance on which every route has something to answer."""

    def __init__(self):
        super().__init__()
        site = self.folder / "demo.toml"
        # There is a code for the first password as soon as clients behind a proxy are served.
        text = site.read_text(encoding="utf-8").replace(
            "[web]\n", '[web]\ntrusted_proxies = ["192.0.2.1"]\n').replace(
                'source = "simulation"', 'source = "http"')
        site.write_text(text + MORE_OF_THE_SITE.format(modbus_port=free_port()), encoding="utf-8")
        (self.folder / "state").mkdir()
        self.cookie = ""

    def environment(self):
        return {"CYCLONEDDS_URI": LOOPBACK_DDS, "STATE_DIRECTORY": str(self.folder / "state")}

    def ask(self, method, path, query=None, body=None, is_endless=False):
        """Status, media type and content of an answer; of an endless one the first bytes."""
        headers = {"Cookie": self.cookie, "X-Orbwatch": "contract"} if self.cookie else {}
        if method == "POST":
            headers["Content-Type"] = "application/json"
        target = path + ("?" + urllib.parse.urlencode(query, doseq=True) if query else "")
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=PATIENCE_S)
        try:
            connection.request(method, target, None if body is None else json.dumps(body), headers)
            answer = connection.getresponse()
            for name, value in answer.getheaders():
                if name == "Set-Cookie":
                    self.cookie = value.split(";")[0]
            is_endless = is_endless and answer.status == 200
            content = answer.read(100) if is_endless else answer.read()
            return answer.status, answer.headers["Content-Type"], content
        finally:
            connection.close()

    def get(self, name, **query):
        status, _, content = self.ask("GET", f"/api/v1/{name}", query)
        if status != 200:
            raise OSError(f"{name}: {status} {content[:200]}")
        return json.loads(content)

    def event(self):
        """Name of the oldest event whose recording has ended; records one if there is none."""
        def events():
            return self.get("recordings")["events"]

        if not events():
            self.ask("POST", "/api/v1/command/record_event", body={})
        return eventually("an event", lambda: [one["name"] for one in events() if one["is_finished"]])[-1]

    def export(self):
        """Number of an export whose file can be fetched."""
        status = self.get("recordings/export")
        if status["state"] != "ready":
            self.ask("POST", "/api/v1/export_recording", body={"event": self.event(), "format": "csv"})
            status = eventually("an export", lambda: [
                one for one in [self.get("recordings/export")] if one["state"] == "ready"])[0]
        return status["number"]

    def replay(self):
        """Number of a replay that has a result."""
        status = self.get("recordings/replay")
        if status["state"] != "done":
            self.ask("POST", "/api/v1/replay_recording", body={"event": self.event()})
            status = eventually("a replay", lambda: [
                one for one in [self.get("recordings/replay")] if one["state"] == "done"])[0]
        return status["number"]

    def first_code(self):
        return (self.folder / "state/first-code").read_text(encoding="utf-8").strip()

    def requests(self):
        """Number since the last restart."""
        return self.get("status")["web"]["requests"]


def json_schema(schema):
    """A schema of OpenAPI 3.0 as one of JSON Schema, draft 4, which has no `nullable`."""
    if isinstance(schema, list):
        return [json_schema(part) for part in schema]
    if not isinstance(schema, dict):
        return schema
    converted = {key: json_schema(part) for key, part in schema.items() if key != "nullable"}
    if schema.get("nullable") is True and "type" in schema:
        converted["type"] = [schema["type"], "null"]
    return converted


def wrong_values(schema):
    """Values that a schema refuses."""
    kind = schema.get("type")
    if kind not in ("integer", "number"):
        return [7] if kind else []
    values = ["nonsense"] + [0.5] * (kind == "integer")
    values += [schema["minimum"] - 1] if "minimum" in schema else []
    return values + ([schema["maximum"] + 1] if "maximum" in schema else [])


def schema_of(content):
    [(media_type, described)] = content.items()
    return media_type, described["schema"]


class Contract(unittest.TestCase):
    """Cases in order: the last ones change the appliance."""

    @classmethod
    def setUpClass(cls):
        cls.appliance = WholeAppliance()
        cls.addClassCleanup(cls.appliance.close)
        cls.appliance.start()
        cls.description = cls.appliance.get("openapi.json")
        cls.appliance.ask("POST", COMMAND + "record_event", body={})
        eventually("an event", cls.appliance.event)
        cls.appliance.ask("POST", "/api/v1/make_support_file", body={})
        cls.operations = {(method.upper(), path): operation
                          for path, methods in cls.description["paths"].items()
                          for method, operation in methods.items()}

    def paths(self, method):
        return [path for asked, path in self.operations if asked == method]

    def faults(self, schema, answer):
        """Differences of an answer from its schema, with their places."""
        root = json_schema({"allOf": [schema], "components": self.description["components"]})
        validator = jsonschema.Draft4Validator(root, format_checker=FORMATS)
        return [f"{'/'.join(map(str, fault.absolute_path))}: {fault.message}"
                for fault in validator.iter_errors(answer)]

    def expect_described(self, operation, status, media_type, content):
        responses = operation["responses"]
        described, schema = schema_of(responses["200" if status == 200 else "default"]["content"])
        self.assertEqual(media_type, described)
        if described == "application/json":
            self.assertEqual(self.faults(schema, json.loads(content)), [])

    def queries(self):
        """Queries that are answered, by path; a path without arguments needs none."""
        get = self.appliance.get
        camera, other = get("alignment")["cameras"][:2]
        name, middle = camera["name"], {"u": camera["width"] // 2, "v": camera["height"] // 2}
        view = {"which": "proposed", "yaw": 10, "pitch": 5, "h_fov": 60, "width": 64, "height": 48,
                "model": "paper"}
        views = [one["name"] for one in get("views")["views"]]
        recipe = get("recipe")
        polygon = {"view": recipe["views"][0]["name"], "pixels": "200,150,400,150,300,300"}
        pixel = {"view": views[0], "u": 40, "v": 30}
        number = get("live/pixel", **pixel)["number"]
        event = {"event": self.appliance.event()}
        frame = {**event, "camera": get("recordings/frames", **event)["cameras"][0]["camera"], "frame": 0}
        signals = get("recordings/signals", **event)["signals"]
        signal = [{**event, "region": one["region"], "figure": one["figure"]} for one in signals if one["region"]][:1]
        signal += [{**event, "figure": one["figure"]} for one in signals if not one["region"]][:1]
        replay = {"number": self.appliance.replay()}
        own = next(one for one in get("appliances")["appliances"] if one["is_self"])
        return {
            "/api/v1/history": [
                {"region": recipe["regions"][0]["name"], "figure": "hot_spot_width"},
                {"camera": name, "figure": "blur"}],
            "/api/v1/history/alarms": [{}, {"events": 0}],
            "/api/v1/recordings": [{}, {
                "trigger": "command", "part": "blade", "layer": 1, "from": "2026-11-28T09:22:00Z",
                "to": "2100-01-01T00:00:00.125Z", "before": event["event"], "limit": 10}],
            "/api/v1/log": [{}, {"lines": 1, "level": "warning", "after": 1}],
            "/snapshot.jpg": [{"view": views[0]}, {"view": views[0], "width": 200}],
            "/stream.mjpg": [{"view": views[0]}, {"view": views[0], "width": 200}],
            "/api/v1/live": [{}, {"view": views}, {"view": views, "width": [200] * len(views)}],
            "/api/v1/live/pixel": [pixel, {**pixel, "number": number}],
            "/api/v1/sphere": [{"view": get("look-around")["spheres"][0]}],
            "/api/v1/alignment/ball.jpg": [{"camera": name}],
            "/api/v1/alignment/view.jpg": [{"camera": name}, {"camera": name, **view}],
            "/api/v1/alignment/pair": [{"camera": other["name"]}, {"camera": other["name"], **view}],
            "/api/v1/alignment/direction": [{"camera": name, **middle}],
            "/api/v1/recipe": [{}, {"number": recipe["number"]}],
            "/api/v1/recipe/polygon": [polygon, {**polygon, "number": recipe["number"]}],
            "/api/v1/appliances/picture.jpg": [{"appliance": own["id"]}],
            "/api/v1/recordings/trigger.jpg": [event],
            "/api/v1/recordings/event.mcap": [event],
            "/api/v1/recordings/frames": [event],
            "/api/v1/recordings/frame.jpg": [frame],
            "/api/v1/recordings/exported": [{"number": self.appliance.export()}],
            "/api/v1/recordings/replayed": [replay],
            "/api/v1/recordings/replayed_signal": [{**replay, **{
                key: value for key, value in signal[0].items() if key != "event"}}],
            "/api/v1/recordings/signals": [event],
            "/api/v1/recordings/regions": [event],
            "/api/v1/recordings/signal": signal,
            "/api/v1/device_file": [{"file": "support"}],
        }

    def expect_answers(self):
        """Asks every GET route. A picture or a history may not be there at once."""
        for path in self.paths("GET"):
            operation = self.operations["GET", path]
            media_type, _ = schema_of(operation["responses"]["200"]["content"])
            is_endless = media_type.startswith("multipart/") or path == "/api/v1/live"
            for place in range(len(self.queries().get(path, [{}]))):
                with self.subTest(path=path, query=place):
                    refusals = []

                    def answer():
                        query = self.queries().get(path, [{}])[place]
                        answer = self.appliance.ask("GET", path, query, is_endless=is_endless)
                        refusals.append(answer)
                        return answer if answer[0] == 200 else None
                    try:
                        self.expect_described(operation, *eventually(path, answer))
                    except AssertionError as error:
                        self.fail(f"{error}; last answer: {str(refusals[-1:])[:300]}")

    def body_of_command(self, path):
        """The lowest value of each argument."""
        _, schema = schema_of(self.operations["POST", path]["requestBody"]["content"])
        return {name: argument["minimum"] for name, argument in schema["properties"].items()}

    def changes(self):
        """Paths and bodies of all changes, in an order in which they are possible; a body is made
        when its turn comes."""
        get = self.appliance.get

        def recipe_file():
            file = next(one for one in get("configuration")["files"] if "recipe" in one["name"])
            return {"files": {file["name"]: file["text"].replace('name = "', 'name = "tried_', 1)}}

        def limit():
            alarm = get("recipe")["alarms"][0]
            return {"recipe": get("recipe")["number"], "limits": [
                {"alarm": alarm["alarm"], "region": alarm["region"], "signal": alarm["signal"],
                 "limit": "high_warning", "value": alarm["high_warning"] + 1}]}

        commands = [path for path in self.paths("POST") if path.startswith(COMMAND)]
        commands.sort(key=lambda path: path == COMMAND + "restart")
        for path in commands:
            yield path, self.body_of_command(path)
        for name, body in [
                ("check_configuration", recipe_file), ("try_configuration", recipe_file),
                ("confirm_configuration", dict), ("check_recipe", limit), ("try_recipe", limit),
                ("revert_configuration", dict), ("forget_appliances", dict),
                ("machine_state", lambda: {"layer": 1}),
                ("pin_recording", lambda: {"event": self.appliance.event(), "is_pinned": True}),
                ("export_recording", lambda: {"event": self.appliance.event(), "format": "csv"}),
                ("cancel_export", lambda: {"number": get("recordings/export")["number"]}),
                ("replay_recording", lambda: {"event": self.appliance.event()}),
                ("cancel_replay", lambda: {"number": get("recordings/replay")["number"]}),
                ("remove_recording", lambda: {"event": self.appliance.event()}),
                ("make_backup", lambda: {"passphrase": None})]:
            yield f"/api/v1/{name}", body()
        status, _, content = self.appliance.ask("GET", "/api/v1/device_file", {"file": "backup"})
        self.assertEqual(status, 200, content)
        for offset in range(0, len(content), UPLOADED_BYTES):
            part = content[offset:offset + UPLOADED_BYTES]
            yield "/api/v1/upload_backup", {"offset": offset, "bytes": base64.b64encode(part).decode()}
        for name, body in [
                ("check_restore", lambda: {"passphrase": None}),
                ("restore", lambda: {"passphrase": None, "cameras": []}),
                ("factory_reset", lambda: {"confirmation": "factory reset"}),
                ("upload_update", lambda: {"offset": 0, "size": 3, "bytes": "YWJj"}),
                ("install_update", dict), ("restart_device", dict),
                ("make_support_file", dict),
                ("set_first_password", lambda: {"code": self.appliance.first_code(),
                                                "password": PASSWORD}),
                ("logout", dict), ("login", lambda: {"user": "admin", "password": PASSWORD}),
                ("set_password", lambda: {"old": PASSWORD, "new": NEXT_PASSWORD}),
                ("set_user", lambda: {"user": "kim", "role": "operator", "password": PASSWORD}),
                ("remove_user", lambda: {"user": "kim"}),
                ("create_token", lambda: {"name": "recorder", "role": "viewer"}),
                ("revoke_token", lambda: {"name": "recorder"}),
                ("create_token", lambda: {"name": "dashboard", "role": "viewer"})]:
            yield f"/api/v1/{name}", body()

    def change(self, path, body):
        """Sends a change. Its answer has the described form, and is not a refusal of the body."""
        name = path.rsplit("/", 1)[1]
        before = self.appliance.requests() if self.is_trusted() else 0
        status, media_type, content = self.appliance.ask("POST", path, body=body)
        self.expect_described(self.operations["POST", path], status, media_type, content)
        if path.startswith(COMMAND):
            self.assertIn("result", json.loads(content), content)
        else:
            self.assertEqual(status, REFUSED.get(name, 200), content)
        if status == 200 and name in RESTARTING | {"try_configuration", "try_recipe",
                                                   "revert_configuration"}:
            eventually(f"a restart by {name}", lambda: self.appliance.says(
                lambda: self.appliance.requests() < before))
        if name.startswith("try_"):
            eventually("the trial runs", lambda: (self.appliance.get(
                "configuration")["trial"] or {}).get("seconds_left") is not None)

    def is_trusted(self):
        return not self.appliance.get("session")["has_users"]

    def test_1_every_answer_has_the_described_form(self):
        self.expect_answers()

    def test_2_every_argument_is_asked(self):
        queries = self.queries()
        for path in self.paths("GET"):
            described = {argument["name"] for argument in
                         self.operations["GET", path].get("parameters", [])}
            self.assertEqual(described, {name for query in queries.get(path, []) for name in query},
                             path)

    def test_3_wrong_arguments_are_refused_by_name(self):
        queries = self.queries()
        for path in self.paths("GET"):
            for argument in self.operations["GET", path].get("parameters", []):
                name, right = argument["name"], queries[path][0]
                # Any text is a right one for an argument without values of its own.
                is_any = argument["schema"]["type"] in ("string", "array")
                wrong = [] if is_any and "enum" not in argument["schema"] else (
                    wrong_values(argument["schema"]))
                cases = [{**right, name: value} for value in wrong]
                if argument["required"]:
                    cases.append({key: right[key] for key in right if key != name})
                self.assertTrue(cases or is_any, f"{path}: {name}")
                for case in cases:
                    self.expect_refused("GET", path, name, query=case)

    def test_4_wrong_bodies_are_refused_by_name(self):
        bodies = {**{path: self.body_of_command(path) for path in self.paths("POST")
                     if path.startswith(COMMAND)},
                  "/api/v1/login": {"user": "admin", "password": PASSWORD},
                  "/api/v1/set_first_password": {"code": "", "password": PASSWORD},
                  "/api/v1/set_password": {"old": PASSWORD, "new": NEXT_PASSWORD},
                  "/api/v1/set_user": {"user": "kim", "role": "operator", "password": PASSWORD},
                  "/api/v1/remove_user": {"user": "kim"},
                  "/api/v1/create_token": {"name": "recorder", "role": "viewer"},
                  "/api/v1/revoke_token": {"name": "recorder"},
                  "/api/v1/pin_recording": {"event": self.appliance.event(), "is_pinned": True},
                  "/api/v1/remove_recording": {"event": self.appliance.event()},
                  "/api/v1/export_recording": {"event": self.appliance.event(), "format": "csv"},
                  "/api/v1/cancel_export": {"number": 1},
                  "/api/v1/replay_recording": {"event": self.appliance.event(), "recipe": 0},
                  "/api/v1/cancel_replay": {"number": 1},
                  "/api/v1/make_backup": {"passphrase": None},
                  "/api/v1/upload_backup": {"offset": 0, "bytes": ""},
                  "/api/v1/upload_update": {"offset": 0, "size": 1, "bytes": ""},
                  "/api/v1/check_restore": {"passphrase": None},
                  "/api/v1/restore": {"passphrase": None},
                  "/api/v1/factory_reset": {"confirmation": "factory reset"},
                  "/api/v1/check_configuration": {"files": {}},
                  "/api/v1/try_configuration": {"files": {}},
                  "/api/v1/check_recipe": {"recipe": 1},
                  "/api/v1/try_recipe": {"recipe": 1}}
        for path in self.paths("POST"):
            _, schema = schema_of(self.operations["POST", path]["requestBody"]["content"])
            right = bodies.get(path, {})
            self.assertEqual(self.faults(schema, right), [], path)
            for name, member in schema["properties"].items():
                for value in wrong_values(member):
                    self.expect_refused("POST", path, name, body={**right, name: value})
                if name in schema.get("required", []):
                    case = {key: right[key] for key in right if key != name}
                    self.expect_refused("POST", path, name, body=case)
            self.expect_refused("POST", path, "the body has an unknown member",
                                body={**right, "nonsense": 1})

    def expect_refused(self, method, path, beginning, **sent):
        """The refusal begins with the argument's name; behind it may follow the whole form."""
        with self.subTest(path=path, **sent):
            status, media_type, content = self.appliance.ask(method, path, **sent)
            self.assertEqual(status, 400, content)
            self.expect_described(self.operations[method, path], status, media_type, content)
            error = json.loads(content)["error"]
            self.assertTrue(error.startswith(f"{beginning} ") or error.startswith(f"{beginning};"),
                            error)

    def test_5_every_change_is_in_the_audit(self):
        sent = set()
        for path, body in self.changes():
            with self.subTest(path=path):
                sent.add(path)
                self.change(path, body)
        self.assertEqual(sent, set(self.paths("POST")))
        noted = collections.Counter(
            entry["what"] for entry in self.appliance.get("audit")["entries"])
        names = {path.rsplit("/", 1)[1] for path in sent}
        self.assertEqual(names - noted.keys(), NOT_AUDITED.keys())

    def test_6_answers_keep_their_form_after_changes(self):
        self.assertFalse(self.is_trusted())
        self.expect_answers()


if __name__ == "__main__":
    unittest.main()
