#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The elevator's page beside the running elevator: from Node.js, by hand, and in chromium.

usage: example_test.py PROGRAM FOLDER NODE

Where chromium is not installed, what needs it is skipped by name.
"""
import json
import os
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import unittest

PROGRAM, FOLDER, NODE = sys.argv[1:4]
CHROMIUM = shutil.which("chromium")


class Elevator:
    """The application, at ports that are free."""

    def __init__(self, policy="allow page@web read,command Elevator\nallow local read,command Elevator\n"):
        self.folder = tempfile.TemporaryDirectory()
        place = self.folder.name
        shutil.copytree(f"{FOLDER}/page", f"{place}/page")
        with open(f"{FOLDER}/elevator.yaml", encoding="utf-8") as file:
            text = file.read().replace(":8080", ":0")
        if policy is None:
            text = text.replace("  policy: page.policy\n", "")
        for name, content in (("elevator.yaml", text), ("page.policy", policy or "")):
            with open(f"{place}/{name}", "w", encoding="utf-8") as file:
                file.write(content)
        self.process = subprocess.Popen([PROGRAM, "run", f"{place}/elevator.yaml", "--listen", "tcp://127.0.0.1:0"],
                                        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, bufsize=1)
        self.tcp = self.url = None
        while not (self.tcp and self.url):
            line = self.process.stdout.readline()
            assert line, "the application ended"
            self.tcp = self.tcp or next(iter(re.findall(r"tcp://\S+", line)), None)
            self.url = self.url or next(iter(re.findall(r"http://\S+", line)), None)
        self.port = int(re.search(r":(\d+)/", self.url).group(1))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.communicate(timeout=60)
        self.folder.cleanup()

    def request(self, head):
        """What the server says to a request, up to the end of its headers."""
        with socket.create_connection(("127.0.0.1", self.port), timeout=20) as connection:
            connection.sendall(head.replace("HOST", f"127.0.0.1:{self.port}").replace("\n", "\r\n").encode() + b"\r\n")
            answer = b""
            while b"\r\n\r\n" not in answer:
                part = connection.recv(4096)
                if not part:
                    break
                answer += part
            return answer.decode("latin-1")


class Browser:
    """Chromium without a window, asked over a pair of pipes."""

    def __init__(self):
        self.folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        to_read, self.to = os.pipe()
        self.from_, to_write = os.pipe()

        def arrange():  # chromium reads at 3 and writes at 4
            read, write = os.dup(to_read), os.dup(to_write)
            os.dup2(read, 3)
            os.dup2(write, 4)

        self.process = subprocess.Popen(
            [CHROMIUM, "--headless", "--no-sandbox", "--disable-gpu", "--remote-debugging-pipe",
             f"--user-data-dir={self.folder.name}", "--window-size=800,500"],
            close_fds=False, preexec_fn=arrange, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_read)
        os.close(to_write)
        self.last, self.rest = 0, b""

    def ask(self, method, session=None, **parameters):
        self.last += 1
        message = {"id": self.last, "method": method, "params": parameters}
        if session:
            message["sessionId"] = session
        os.write(self.to, json.dumps(message).encode() + b"\0")
        while True:
            while b"\0" not in self.rest:
                part = os.read(self.from_, 1 << 16)
                assert part, "chromium ended"
                self.rest += part
            text, _, self.rest = self.rest.partition(b"\0")
            answer = json.loads(text)
            if answer.get("id") == self.last:
                gone = "context was destroyed" in answer.get("error", {}).get("message", "")
                assert gone or "error" not in answer, answer
                return answer.get("result")

    def open(self, url):
        target = self.ask("Target.createTarget", url=url)["targetId"]
        return self.ask("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]

    def run(self, page, script):
        """What the script, which may wait, comes to."""
        result = None
        while result is None:  # a page that is being loaded begins anew
            result = self.ask("Runtime.evaluate", page, expression=script, awaitPromise=True, returnByValue=True)
        assert "exceptionDetails" not in result, result
        return result["result"].get("value")

    def close(self):
        self.process.kill()
        self.process.wait()
        for end in (self.to, self.from_):
            os.close(end)
        self.folder.cleanup()


UNTIL = """new Promise((resolve) => {
  const look = () => (CONDITION) ? resolve(document.body.innerText + '|' + location.hash) : setTimeout(look, 10);
  look();
})"""


def until(condition):
    return UNTIL.replace("CONDITION", condition)


UPGRADE = ("GET / HTTP/1.1\nHost: HOST\nUpgrade: websocket\nConnection: Upgrade\nOrigin: http://HOST\n"
           "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\nSec-WebSocket-Version: 13\n")


class Lift:
    """The elevator in Node.js."""

    def __enter__(self):
        self.process = subprocess.Popen([NODE, f"{FOLDER}/lift.mjs", "tcp://127.0.0.1:0"], stdout=subprocess.PIPE, text=True)
        self.tcp = self.process.stdout.readline().split()[-1]
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.communicate(timeout=60)


# An application of its own that uses an elevator elsewhere, by the interface file alone.
HALL = """application: hall
network: {}
components:
  Elevator: {remote: "ADDRESS/Elevator", interface: elevator.idl}
"""
RIDE_UP = """
print("top " .. Elevator:top())
print(select(2, wait(Elevator:travel(5))))
print(wait(Elevator:travel(0.2)))
stop()
"""


def hall(address, tokens=None):
    """What an application prints that uses the elevator at an address."""
    with tempfile.TemporaryDirectory() as folder:
        shutil.copy(f"{FOLDER}/elevator.idl", folder)
        options = []
        for name, content in (("hall.yaml", HALL.replace("ADDRESS", address)), ("ride.lua", RIDE_UP), ("tokens", tokens)):
            if content is not None:
                with open(f"{folder}/{name}", "w", encoding="utf-8", opener=lambda path, flags: os.open(path, flags, 0o600)) as file:
                    file.write(content)
        if tokens is not None:
            options = ["--tokens", f"{folder}/tokens"]
        return subprocess.run([PROGRAM, "run", f"{folder}/hall.yaml", "--script", f"{folder}/ride.lua", "--for", "30s", *options],
                              capture_output=True, text=True, timeout=120)


class ProgramTest(unittest.TestCase):
    def look_at(self, address):
        done = subprocess.run([NODE, f"{FOLDER}/operator.mjs", address], capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        lines = [line.split(", travel: ")[-1] for line in done.stdout.splitlines()]
        self.assertEqual(lines[0], "the shaft ends at 3 m")
        self.assertIn("the target is outside the shaft", lines[1])
        self.assertEqual(lines[2], "arrived at 0.2 m")
        self.assertTrue(lines[3].startswith("cancelled"), lines)

    def ride(self, done):
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        for expected in ("top 3", "the target is outside the shaft", "true"):
            self.assertIn(expected, done.stdout, done.stderr)

    def test_nodejs_shows_and_commands_the_elevator(self):
        with Elevator() as elevator:
            self.look_at(elevator.tcp)

    def test_a_lift_in_nodejs_is_the_same_to_its_operator(self):
        with Lift() as lift:
            self.look_at(lift.tcp)

    def test_a_deployment_uses_the_lift_in_nodejs(self):
        with Lift() as lift:
            self.ride(hall(lift.tcp))

    def test_a_deployment_uses_the_elevator_over_a_websocket(self):
        with Elevator() as elevator:
            address = f"ws://127.0.0.1:{elevator.port}"
            self.ride(hall(address, elevator.url + "\n"))
            refused = hall(address)
            self.assertNotIn("top", refused.stdout)
            self.assertIn("it lets this side not in (403)", refused.stdout + refused.stderr)

    def test_the_task_browser_looks_over_a_websocket(self):
        with Elevator("allow page@web read *\n") as elevator, tempfile.NamedTemporaryFile("w") as tokens:
            tokens.write(elevator.url)
            tokens.flush()
            done = subprocess.run([PROGRAM, "browse", f"ws://127.0.0.1:{elevator.port}", "--tokens", tokens.name],
                                  input="Elevator.Top\n", capture_output=True, text=True, timeout=120)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertIn("3 m", done.stdout)


class PageTest(unittest.TestCase):

    def test_only_who_has_the_cookie_gets_a_socket(self):
        with Elevator() as elevator:
            self.assertIn(" 403 ", elevator.request(UPGRADE))
            token = elevator.url.partition("#")[2]
            answer = elevator.request(f"POST /token HTTP/1.1\nHost: HOST\nOrigin: http://HOST\n"
                                      f"Authorization: Bearer {token}\nContent-Length: 0\n")
            cookie = re.search(r"set-cookie: ([^;]+); HttpOnly; SameSite=Strict", answer).group(1)
            self.assertIn(" 101 ", elevator.request(UPGRADE + f"Cookie: {cookie}\n"))

    def test_mistakes_of_a_deployment_are_told_before_anything_listens(self):
        with tempfile.TemporaryDirectory() as folder:
            os.mkdir(f"{folder}/site")
            shutil.copy(f"{FOLDER}/page/index.html", f"{folder}/site")
            for network, text in (
                    ("listen: ws://127.0.0.1:0", "'ws://127.0.0.1:0' has no pages to serve"),
                    ("listen: ws://0.0.0.0:0, pages: site", "pages are served to this machine only"),
                    ("listen: ws://127.0.0.1:0, pages: nowhere", "nowhere' cannot be read"),
                    ("listen: ws://127.0.0.1:0, pages: .", "has no index.html")):
                file = f"{folder}/wrong.yaml"
                with open(file, "w", encoding="utf-8") as wrong:
                    wrong.write(f"libraries: [elevator]\nnetwork: {{{network}}}\n"
                                "components: {E: {model: Elevator, activity: {periodic: 20 ms}}}\n")
                for command in ("check", "run"):
                    done = subprocess.run([PROGRAM, command, file], capture_output=True, text=True, timeout=60)
                    self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
                    self.assertRegex(done.stdout + done.stderr, r"wrong\.yaml:2:\d+: error: .*" + re.escape(text))


@unittest.skipUnless(CHROMIUM, "chromium is not installed: nobody has run the page")
class PageInChromiumTest(unittest.TestCase):
    def setUp(self):
        self.browser = Browser()
        self.addCleanup(self.browser.close)

    def test_the_page_shows_and_commands_the_elevator(self):
        with Elevator() as elevator:
            page = self.browser.open(elevator.url)
            shown = self.browser.run(page, until("document.getElementById('height')?.value === '0.00'"))
            self.assertTrue(shown.endswith("|"), "the token stays in the address")
            self.browser.run(page, "target.value = 0.3; go.click()")
            shown = self.browser.run(page, until("told.textContent !== ''"))
            self.assertIn("arrived at 0.3 m", shown)
            self.assertIn("0.30", self.browser.run(page, until("height.value === '0.30'")))
            self.browser.run(page, "told.textContent = ''; target.value = 7; go.click()")
            self.assertIn("outside the shaft", self.browser.run(page, until("told.textContent !== ''")))
            self.browser.run(page, "told.textContent = ''; target.value = 3; go.click()")
            self.browser.run(page, until("height.value > 0.4"))
            self.browser.run(page, "document.getElementById('stop').click()")
            self.assertIn("cancelled", self.browser.run(page, until("told.textContent !== ''")))
            # A visit later needs no token; another address without one gets nothing.
            again = self.browser.open(elevator.url.partition("#")[0])
            self.browser.run(again, until("document.getElementById('height')?.value > 0.4"))

    def test_without_the_token_the_page_says_what_is_missing(self):
        with Elevator() as elevator:
            for url in (elevator.url.partition("#")[0], elevator.url[:-1] + "x"):
                page = self.browser.open(url)
                shown = self.browser.run(page, until("document.getElementById('told')?.textContent"))
                self.assertRegex(shown, "refused|not good any more")

    def test_a_page_may_do_what_the_policy_says_and_without_one_only_look(self):
        for policy in (None, "allow page@web read Elevator\nallow local read,command Elevator\n"):
            with Elevator(policy) as elevator:
                page = self.browser.open(elevator.url)
                self.browser.run(page, until("document.getElementById('height')?.value === '0.00'"))
                self.browser.run(page, "go.click()")
                self.assertRegex(self.browser.run(page, until("told.textContent !== ''")),
                                 "page@web may not command 'Elevator'")

    def test_a_page_that_is_closed_moves_nothing_any_more(self):
        with Elevator() as elevator:
            page = self.browser.open(elevator.url)
            self.browser.run(page, until("document.getElementById('height')?.value === '0.00'"))
            self.browser.run(page, "target.value = 3; go.click()")
            self.browser.run(page, until("height.value > 0.1"))
            target = self.browser.ask("Target.getTargetInfo", page)["targetInfo"]["targetId"]
            self.browser.ask("Target.closeTarget", targetId=target)
            line = ""
            while "Elevator.travel" not in line:
                line = elevator.process.stdout.readline()
                self.assertTrue(line, "the application ended")
            self.assertIn("is cancelled: the connection to page@web", line)

    def test_the_page_says_when_the_application_has_gone(self):
        with Elevator() as elevator:
            page = self.browser.open(elevator.url)
            self.browser.run(page, until("document.getElementById('height')?.value === '0.00'"))
            elevator.process.kill()
            self.assertIn("lost:", self.browser.run(page, until("told.textContent !== ''")))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
