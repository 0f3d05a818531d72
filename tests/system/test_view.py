"""osculate view: a run in the browser while it goes on. Usage: test_view.py PROGRAM"""
import csv
import http.client
import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.error
import urllib.parse
import urllib.request

PROGRAM = sys.argv[1]
MODEL = """osculate: 1
title: watched <block>
mesh: {generate: {block: {box: {x: [0, 4], y: [0, 2], elements: [24, 12]}}}}
materials: {s: {linear_elastic: {E: 1.0e4, nu: 0.3}}}
sections: [{on: block, material: s, element: plane_strain}]
rigid: {floor: {line: {point: [0, 0], normal: [0, 1]}}}
contact: [{name: c, master: floor, slave: block.bottom, normal: {penalty: 1.0e6}, friction: {coulomb: {mu: 0.2, penalty: 1.0e6}}}]
solver: {max_iterations: ITERATIONS}
steps:
  - {name: press, increments: 4, prescribe: [{on: block.top, ux: 0, uy: -0.05}]}
  - {name: push, increments: INCREMENTS, prescribe: [{on: block.top, ux: 0.2}]}
output: {OUTPUT history: [{on: c, of: normal_force}, {on: c, of: shear_force}, {on: c, of: slipping}]}
"""


def model(increments=200, iterations=25, output=""):
    return (MODEL.replace("INCREMENTS", str(increments)).replace("ITERATIONS", str(iterations))
            .replace("OUTPUT", output))


class View(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.url = None

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def write(self, text, name="m.yaml"):
        with open(self.path(name), "w") as file:
            file.write(text)

    def content(self, name):
        with open(self.path("m.results", name), "rb") as file:
            return file.read()

    def table(self, name):
        """Whole rows of a table that may grow, as numbers."""
        text = self.content(name).decode()
        lines = list(csv.reader(text[:text.rfind("\n")].split("\n")))
        return [[float(cell) for cell in line] for line in lines[1:]]

    def start(self, *arguments):
        process = subprocess.Popen([PROGRAM, *arguments], cwd=self.folder, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        self.addCleanup(self.end, process)
        return process

    @staticmethod
    def end(process):
        if process.poll() is None:
            process.send_signal(signal.SIGCONT)
            process.kill()
        process.communicate()

    def view(self, *arguments):
        process = self.start("view", *arguments)
        self.url = process.stdout.readline().strip()
        self.assertRegex(self.url, r"^http://127\.0\.0\.1:\d+/$")
        return process

    def get(self, path):
        with urllib.request.urlopen(self.url + path, timeout=20) as answer:
            return answer.read()

    def state(self, run="", number=0):
        return json.loads(self.get(f"state.json?run={urllib.parse.quote(run)}&from={number}"))

    def run_until(self, rows, *more):
        """A run that stands still when so many rows of its history are there."""
        process = self.start("run", "m.yaml", *more)
        end = time.time() + 60
        while time.time() < end:
            try:
                if len(self.table("history.csv")) >= rows:
                    process.send_signal(signal.SIGSTOP)
                    os.waitid(os.P_PID, process.pid, os.WSTOPPED)
                    return process
            except FileNotFoundError:
                pass
            self.assertIsNone(process.poll(), "the run ended before it was to be stopped")
            time.sleep(0.002)
        self.fail("the run did not come so far")

    def go_on(self, process):
        process.send_signal(signal.SIGCONT)
        process.communicate()
        self.assertEqual(process.returncode, 0)

    def steps_of(self, state):
        """The increments of each step, as summary.json has them."""
        steps = {}
        for entry in state["entries"]:
            if "increment" in entry:
                steps.setdefault(entry["step"], []).append(entry["increment"])
        return [steps[number] for number in sorted(steps)]

    def expect_the_end(self, state):
        summary = json.loads(self.content("summary.json"))
        self.assertEqual(state["status"], "done")
        self.assertEqual(self.steps_of(state), [step["increments"] for step in summary["steps"]])
        self.assertEqual([entry["row"] for entry in state["entries"]], self.table("history.csv"))
        self.assertEqual(json.loads(self.get("report.json"))["summary"], summary)
        return summary

    # ---- while a run goes on ----

    def test_a_run_that_goes_on_is_shown_as_its_files_have_it(self):
        self.write(model())
        run = self.run_until(8)
        self.view("m.results")
        state = self.state()
        self.assertEqual((state["status"], state["model"], state["from"]), ("running", "m.yaml", 0))
        self.assertEqual(state["columns"], ["step", "increment", "time", "c.normal_force", "c.shear_force", "c.slipping"])
        entries = state["entries"]
        history = self.table("history.csv")
        # a row is written before its entry: the run may stand still in between
        self.assertIn(len(history) - len(entries), (0, 1))
        self.assertGreater(len(entries), 6)
        self.assertEqual([entry["row"] for entry in entries], history[:len(entries)])
        rows = self.table("iterations.csv")
        last = [row for row in rows if row[:2] == rows[-1][:2]]
        self.assertEqual(state["iterations"], last)
        self.assertEqual(state["log"], self.content("log.txt").decode().splitlines()[-8:])
        for entry in entries[1:]:  # what converged, and what was told of it iteration by iteration
            told = [row for row in rows if row[:2] == entry["row"][:2]]
            self.assertEqual([row[4] for row in told], entry["increment"]["residuals"])
            self.assertEqual(told[-1][7:], [entry["increment"][key] for key in ("open", "stick", "slipping", "closed")])
            self.assertEqual(told[-1][2], entry["row"][2])
        # only what is new
        again = self.state(state["run"], len(entries) - 2)
        self.assertEqual((again["from"], again["entries"]), (len(entries) - 2, entries[-2:]))
        self.assertEqual(self.state("another", 3)["from"], 0)
        # the picture
        base = json.loads(self.get("report.json"))
        self.assertEqual((base["status"], base["title"], base["frames"]), ("running", "watched <block>", []))
        self.assertEqual([step["name"] for step in base["summary"]["steps"]], ["press", "push"])
        self.assertEqual(base["mesh"]["points"]["shape"], [25 * 13, 2])
        number = len(entries) - 1
        self.assertTrue(entries[number]["frame"])
        early = json.loads(self.get(f"frame.json?entry={number}"))
        self.assertEqual([early["step"], early["increment"], early["time"]], entries[number]["row"][:3])
        self.go_on(run)
        # the end
        self.expect_the_end(self.state(state["run"], 0))
        final = json.loads(self.get("report.json"))
        self.assertEqual(final, json.loads(self.content("report.json")))
        self.assertEqual(final["mesh"], base["mesh"])
        late = json.loads(self.get("frame.json?entry=204"))
        late.pop("rigid")  # the report has it apart
        self.assertEqual(late, final["frames"][-1])

    def test_attempts_that_are_dropped_are_told_of(self):
        self.write(model(increments=2, iterations=3))
        done = self.start("run", "m.yaml", "--quiet")
        done.communicate()
        summary = json.loads(self.content("summary.json"))
        increments = [i for step in summary["steps"] for i in step["increments"]]
        rows = self.table("iterations.csv")
        self.assertGreater(sum(i["cutbacks"] for i in increments), 0)
        self.assertGreater(sum(i["wasted_iterations"] for i in increments), 0)
        self.assertEqual(summary["status"], "done")
        self.assertEqual(len(rows), sum(i["iterations"] + i["wasted_iterations"] for i in increments))

    def test_a_run_that_was_killed_is_shown_and_its_restart(self):
        self.write(model(increments=30, output="checkpoint: 1,"))
        run = self.run_until(8)
        self.end(run)
        self.view("m.yaml")  # the model stands for its results
        state = self.state()
        self.assertEqual(state["status"], "killed")
        known = len(state["entries"])
        self.assertGreater(known, 6)
        self.go_on(self.start("run", "m.yaml", "--restart"))
        after = self.state(state["run"], known)  # the same increments, and those that came after them
        after["entries"] = state["entries"][:after["from"]] + after["entries"]
        self.expect_the_end(after)

    def test_the_next_run_in_the_folder_is_another(self):
        self.write(model(increments=2))
        self.go_on(self.start("run", "m.yaml"))
        self.view("m.results")
        first = self.state()
        self.expect_the_end(first)
        self.write(model(increments=3))
        self.go_on(self.start("run", "m.yaml"))
        second = self.state(first["run"], len(first["entries"]))
        self.assertEqual((second["from"], len(second["entries"])), (0, len(first["entries"]) + 1))
        self.expect_the_end(second)

    def test_another_journal_in_the_same_file_is_another_run(self):
        self.write(model(increments=2))
        self.go_on(self.start("run", "m.yaml"))
        self.write(model(increments=9))
        self.go_on(self.start("run", "m.yaml", "-o", "other"))
        self.view("m.results")
        first = self.state()
        self.assertEqual(len(first["entries"]), 7)
        with open(self.path("other", "journal.bin"), "rb") as file:
            other = file.read()
        with open(self.path("m.results", "journal.bin"), "r+b") as file:  # as a number that is given out again
            self.assertGreater(len(other), len(file.read()))
            file.seek(0)
            file.write(other)
        second = self.state(first["run"], 7)
        self.assertNotEqual(second["run"], first["run"])
        self.assertEqual((second["from"], len(second["entries"])), (0, 14))

    def test_a_journal_of_another_version_is_told_of(self):
        self.write(model(increments=1))
        self.go_on(self.start("run", "m.yaml"))
        with open(self.path("m.results", "journal.bin"), "r+b") as file:
            head = file.readline()
            file.seek(0)
            file.write(head[:-2] + (b"0" if head[-2:-1] != b"0" else b"1"))
        self.view("m.results")
        state = self.state()
        self.assertEqual((state["status"], state["entries"]), ("done", []))
        self.assertIn("is of another version", state["message"])
        self.assertEqual(self.code("frame.json?entry=0"), 404)

    def test_a_picture_may_be_the_first_that_is_asked_for(self):
        self.write(model(increments=1))
        self.go_on(self.start("run", "m.yaml"))
        self.view("m.results/")
        self.assertEqual(json.loads(self.get("frame.json?entry=0"))["time"], 0)
        for entry in ("-1", "x", "99", "", "0x", "1 "):
            self.assertEqual(self.code("frame.json?entry=" + urllib.parse.quote(entry)), 404, entry)
        self.assertEqual(self.code("frame.json"), 404)
        self.assertIn("<title>m.results</title>", self.get("").decode())

    def test_a_client_that_takes_nothing_does_not_hold_up_the_end(self):
        self.write(model(increments=1))
        self.go_on(self.start("run", "m.yaml"))
        with open(self.path("m.results", "report.json"), "wb") as file:
            file.write(b" " * 64_000_000)  # more than the system keeps for a client
        process = self.view("m.results")
        port = urllib.parse.urlsplit(self.url).port
        with socket.create_connection(("127.0.0.1", port), timeout=20) as connection:
            connection.sendall(f"GET /report.json HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\n\r\n".encode())
            self.assertEqual(connection.recv(1), b"H")
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=2)
        self.assertEqual(process.returncode, 0)

    def test_watching_disturbs_no_run_that_begins(self):
        self.write(model(increments=1))
        self.go_on(self.start("run", "m.yaml"))
        with open(self.path("m.results", "running.lock"), "w") as file:
            file.write("process 0 on nowhere")  # as a killed run leaves it
        self.view("m.results")
        stop = time.time() + 3
        runs = 0
        while time.time() < stop:
            run = self.start("run", "m.yaml", "--quiet")
            while run.poll() is None:
                self.state()
            self.go_on(run)
            runs += 1
        self.assertGreater(runs, 2)

    def test_without_report_and_checkpoints_there_are_iterations_and_log(self):
        self.write(model(increments=2, output="report: false, checkpoint: none, fields: none,"))
        self.go_on(self.start("run", "m.yaml"))
        self.view("m.results")
        state = self.state()
        self.assertEqual((state["status"], state["entries"]), ("done", []))
        self.assertEqual(state["iterations"][-1], self.table("iterations.csv")[-1])
        self.assertEqual(self.code("report.json"), 404)

    # ---- what it serves, and to whom ----

    def code(self, path, method="GET", host=None):
        connection = http.client.HTTPConnection("127.0.0.1", urllib.parse.urlsplit(self.url).port, timeout=20)
        connection.putrequest(method, "/" + path, skip_host=host is not None)
        if host is not None:
            connection.putheader("Host", host)
        connection.endheaders()
        answer = connection.getresponse()
        answer.read()
        connection.close()
        return answer.status

    def raw(self, text):
        port = urllib.parse.urlsplit(self.url).port
        with socket.create_connection(("127.0.0.1", port), timeout=20) as connection:
            connection.sendall(text.replace("PORT", str(port)).encode())
            try:
                return connection.makefile("rb").read().decode()
            except ConnectionResetError:
                return ""

    def test_only_the_files_of_the_run_are_served_and_only_to_this_machine(self):
        self.write(model(increments=1))
        self.go_on(self.start("run", "m.yaml"))
        self.write("secret", "secret.txt")
        process = self.view("m.results")
        for name in ("summary.json", "history.csv", "iterations.csv", "log.txt", "report.json"):
            self.assertEqual(self.get(name), self.content(name))
        page = self.get("").decode()
        self.assertIn("connect-src 'self'", page)
        self.assertIn("<title>m.results</title>", page)
        for path in ("../secret.txt", "%2e%2e/secret.txt", "..%2fsecret.txt", "/etc/passwd", self.path("secret.txt"),
                     "m.results/log.txt", "./log.txt", "checkpoint.bin", "nothing", "log.txt%00", "frame.json?entry=99",
                     "frame.json?entry=-1"):
            self.assertEqual(self.code(path), 404, path)
        self.assertIn("404", self.raw("GET /../secret.txt HTTP/1.1\r\nHost: 127.0.0.1:PORT\r\n\r\n").split("\r\n")[0])
        os.remove(self.path("m.results", "log.txt"))
        os.symlink(self.path("secret.txt"), self.path("m.results", "log.txt"))
        self.assertEqual(self.code("log.txt"), 404)
        self.assertEqual(self.state()["log"], [])
        for method in ("POST", "PUT", "DELETE", "HEAD", "OPTIONS"):
            self.assertEqual(self.code("summary.json", method), 405, method)
        for host in ("example.org", "example.org:80", ""):
            self.assertEqual(self.code("summary.json", host=host), 403, host)
        port = urllib.parse.urlsplit(self.url).port
        self.assertEqual(self.code("summary.json", host=f"localhost:{port}"), 200)
        for text in ("nonsense\r\n\r\n", "GET\r\n\r\n", "GET /\r\n\r\n", "GET / FTP/1.1\r\n\r\n"):
            self.assertIn("400", self.raw(text).split("\r\n")[0], text)
        self.assertEqual(self.raw("GET / HTTP/1.1\r\nHost: " + 20000 * "x" + "\r\n\r\n"), "")
        with self.assertRaises(ConnectionRefusedError):  # another address of this machine
            socket.create_connection(("127.0.0.2", port), timeout=5)
        with socket.create_connection(("127.0.0.1", port), timeout=5):  # one that says nothing holds nobody up
            self.assertEqual(self.code("summary.json"), 200)
        process.send_signal(signal.SIGINT)
        said, warned = process.communicate(timeout=20)
        self.assertEqual((process.returncode, said, warned), (0, "", ""))

    def test_sigterm_ends_it_as_ctrl_c_does(self):
        self.write(model(increments=1))
        self.go_on(self.start("run", "m.yaml"))
        process = self.view("m.results", "--port", "0")
        process.terminate()
        process.communicate(timeout=20)
        self.assertEqual(process.returncode, 0)

    def refused(self, *arguments, says):
        done = subprocess.run([PROGRAM, "view", *arguments], cwd=self.folder, capture_output=True, text=True, timeout=20)
        self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
        self.assertIn(says, done.stderr)

    def test_what_is_no_run_is_refused(self):
        self.write(model(increments=1))
        self.refused("nowhere", says="there is no folder 'nowhere'")
        self.refused("m.yaml", says="there are no results of 'm.yaml' yet: no folder 'm.results'")
        self.refused(".", says="folder '.' holds no run of osculate")
        os.mkdir(self.path("study"))
        self.write('{"model": "m.yaml", "status": "done", "runs": 3, "done": 3}', "study/summary.json")
        self.refused("study", says="folder 'study' holds a study: name the folder of one of its runs")
        self.write("{", "study/summary.json")
        self.refused("study", says="holds no run")
        self.go_on(self.start("run", "m.yaml"))
        with socket.socket() as taken:
            taken.bind(("127.0.0.1", 0))
            taken.listen()
            port = str(taken.getsockname()[1])
            self.refused("m.results", "--port", port, says=f"cannot listen at port {port}")
        self.refused("m.results", "--port", "70000", says="--port")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
