"""Pieces on other machines: the same plan with workers, whatever becomes of them and their server.

A real NATS server on a free port, real workers. Left out where the build has no workers, or where
nats-server is not installed.
"""

import json
import os
import re
import shutil
import signal
import socket
import subprocess
import threading
import time
import unittest

from command import COMMAND, PATIENCE_S, CommandTest

SERVER = shutil.which("nats-server") or shutil.which("nats-server", path="/usr/sbin:/usr/local/bin")
BUILD_HAS_WORKERS = "libnats" not in subprocess.run(
    [COMMAND, "worker", "--server", "x"], stderr=subprocess.PIPE, check=False).stderr.decode()
PASSWORD = "secret-of-the-fleet"
# Plans, until workers were in time to help with one.
TRIES = 20


class Lines:
    """What a process prints, line by line, read beside the test."""

    def __init__(self, stream):
        self.lines = []
        self.changed = threading.Condition()
        thread = threading.Thread(target=self.read, args=(stream,), daemon=True)
        thread.start()

    def read(self, stream):
        for line in stream:
            with self.changed:
                self.lines.append(line.rstrip("\n"))
                self.changed.notify_all()

    def count(self, part):
        return sum(part in line for line in self.lines)

    def sees(self, part, seconds, count=1):
        with self.changed:
            return self.changed.wait_for(lambda: self.count(part) >= count, seconds)

    def wait_for(self, part, count=1):
        if not self.sees(part, PATIENCE_S, count):
            raise AssertionError(f"no {part!r} in {self.lines}")


class FreezingServer:
    """Stands before the server for one client, and reads nothing more once that one listens."""

    def __init__(self, host, port):
        self.server = socket.create_connection((host, port))
        self.door = socket.socket()
        # What has been said and is not read fills buffers soon.
        self.door.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        self.door.bind((host, 0))
        self.door.listen(1)
        self.port = self.door.getsockname()[1]
        self.frozen = threading.Event()
        self.client = None

    def __enter__(self):
        threading.Thread(target=self.forward_questions, daemon=True).start()
        return self

    def __exit__(self, *_):
        for connection in (self.server, self.door, self.client):
            connection.close()

    def forward_questions(self):
        self.client, _ = self.door.accept()
        threading.Thread(target=self.forward_answers, daemon=True).start()
        seen = b""
        while b"SUB split_mapf.*" not in seen:
            words = self.client.recv(4096)
            if not words:
                return
            self.server.sendall(words)
            seen = seen[-100:] + words
        self.frozen.set()

    def forward_answers(self):
        try:
            while True:
                self.client.sendall(self.server.recv(1 << 16))
        except OSError:
            pass


@unittest.skipUnless(SERVER and BUILD_HAS_WORKERS, "no nats-server, or a build without libnats")
class WorkersCase(CommandTest):
    # Eight pieces and more, some of a tenth of a second.
    OPTIONS = ("--solver", "ecbs", "--suboptimality", "1.02", "--split", "2s4t", "--threads", "1",
               "--objective", "sum_of_costs")
    prefix = ()  # before each command of the server's and the workers' side
    plan_prefix = ()  # before each of the other
    host = "127.0.0.1"
    without_workers = None  # the result, the same for all tests

    def setUp(self):
        super().setUp()
        self.generate("p", "--width", 40, "--height", 40, "--density", 0.1, "--agents", 200)
        self.port = 0
        self.start_server()

    # --- The processes ---

    def run_beside(self, command, prefix=None, **options):
        words = [*(self.prefix if prefix is None else prefix), *map(str, command)]
        process = subprocess.Popen(words, cwd=self.folder, stdin=subprocess.DEVNULL,
                                   universal_newlines=True, **options)

        def clean():
            if process.poll() is None:
                process.kill()
            process.communicate()

        self.addCleanup(clean)
        return process

    def start_server(self, more=""):
        self.write("server.conf", f"""
            listen: "{self.host}:{self.port or -1}"
            jetstream {{ store_dir: "{self.path('store')}", max_memory_store: 64MB }}
            authorization {{ user: fleet, password: "{PASSWORD}" }}
            {more}""")
        self.server = self.run_beside(
            [SERVER, "-c", self.path("server.conf"), "--ports_file_dir", self.folder],
            stderr=subprocess.DEVNULL)
        ports = self.path(f"{os.path.basename(SERVER)}_{self.server.pid}.ports")
        end = time.monotonic() + PATIENCE_S
        while not os.path.exists(ports) or os.path.getsize(ports) == 0:
            self.assertLess(time.monotonic(), end, "the server does not come up")
            time.sleep(0.01)
        with open(ports) as file:
            self.port = int(json.load(file)["nats"][0].rsplit(":", 1)[1])

    def url(self, who=f"fleet:{PASSWORD}@", scheme="nats"):
        return f"{scheme}://{who}{self.host}:{self.port}"

    def start_worker(self, command=COMMAND, url=None, **options):
        worker = self.run_beside([command, "worker", "--threads", 1, "--server",
                                  url or self.url()], stdout=subprocess.PIPE, **options)
        worker.lines = Lines(worker.stdout)
        worker.lines.wait_for("ready")
        return worker

    def begin_plan(self, url=None, words=OPTIONS, **options):
        return self.run_beside(
            [COMMAND, "plan", *self.files("p"), *words, "--output", "p.json", "--workers",
             url or self.url()], prefix=self.plan_prefix, stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE, **options)

    def begin_plan_with(self, worker):
        """A plan of which the worker has begun a piece. One that was done alone is begun anew."""
        for _ in range(TRIES):
            begun = worker.lines.count("begun")
            plan = self.begin_plan()
            while plan.poll() is None:
                if worker.lines.sees("begun", 0.02, begun + 1):
                    return plan
            self.end_plan(plan)
        raise AssertionError(f"no plan in {TRIES} was helped with: {worker.lines.lines}")

    def require_help(self, *where, **options):
        """The plans are right, and workers answer of one: they may be too late for another."""
        for _ in range(TRIES):
            if self.end_plan(self.begin_plan(*where, **options)) > 0:
                return
        raise AssertionError(f"no plan in {TRIES} was helped with: {self.error}")

    def end_plan(self, process):
        """Requires the plan that there is without workers; returns how many answers came."""
        _, error = process.communicate(timeout=PATIENCE_S)
        self.assertEqual(process.returncode, 0, error)
        self.assertEqual(self.result(), self.alone())
        self.assertNotIn(PASSWORD, error)
        self.error = error
        answers = re.search(r"(\d+) answer", error)
        return int(answers.group(1)) if answers else 0

    def result(self):
        result = self.read_json("p.json")
        # All but the seconds.
        return ([result[name] for name in ("paths", "status", "message", "makespan", "sum_of_costs",
                                           "layout")],
                [[piece[name] for name in ("agents", "horizon", "phase", "region", "solver",
                                           "status")] for piece in result["subproblems"]])

    def alone(self):
        if WorkersCase.without_workers is None:
            os.rename(self.path("p.json"), self.path("with.json"))
            self.plan(0, "p", *self.OPTIONS)
            WorkersCase.without_workers = self.result()
        return WorkersCase.without_workers



class WorkersTest(WorkersCase):
    def test_the_plan_is_the_same_with_workers(self):
        for _ in range(2):
            self.start_worker()
        self.require_help()

    def test_a_worker_is_killed_in_mid_piece(self):
        worker = self.start_worker()
        plan = self.begin_plan_with(worker)
        worker.kill()
        self.end_plan(plan)

    def test_a_worker_freezes_in_mid_piece(self):
        worker = self.start_worker()
        plan = self.begin_plan_with(worker)
        worker.send_signal(signal.SIGSTOP)
        self.end_plan(plan)
        worker.send_signal(signal.SIGCONT)
        self.require_help()

    def test_a_frozen_workers_piece_goes_to_another(self):
        if not any(self.hand_over() for _ in range(TRIES)):
            self.fail("no piece went from one worker to another")

    def hand_over(self):
        """Freezes a worker. @return whether it was at a piece then, which another one got."""
        frozen = self.start_worker()
        plan = self.begin_plan_with(frozen)
        plan.send_signal(signal.SIGSTOP)  # else it solves the piece itself
        frozen.send_signal(signal.SIGSTOP)
        os.waitid(os.P_PID, frozen.pid, os.WSTOPPED)
        said = "\n".join(frozen.lines.lines)
        at = set(re.findall(r"piece (\S+) begun", said)) - set(re.findall(r"piece (\S+) ended", said))
        other = self.start_worker()
        # It hears of a client that is frozen, too, for so long only.
        is_handed_over = bool(at) and other.lines.sees(f"piece {at.pop()} begun", 6)
        plan.send_signal(signal.SIGCONT)
        answers = self.end_plan(plan)
        frozen.kill()
        other.kill()
        return is_handed_over and answers > 0

    def test_what_waits_beside_a_withdrawn_piece_is_given_out(self):
        # The queue is being read when it happens, by somebody who takes nothing.
        reader = self.start_worker()
        reader.send_signal(signal.SIGSTOP)
        if not any(self.give_out_the_rest() for _ in range(TRIES)):
            self.fail("no piece was given out once another had been withdrawn")

    def give_out_the_rest(self):
        """Freezes a client once it has withdrawn a piece. @return whether a worker got another."""
        with socket.create_connection((self.host, self.port)) as connection:
            connection.settimeout(PATIENCE_S)
            hello = json.dumps({"verbose": False, "user": "fleet", "pass": PASSWORD})
            connection.sendall(f"CONNECT {hello}\r\nSUB split_mapf.clients.> 1\r\nPING\r\n".encode())
            seen = b""
            while b"PONG" not in seen:
                seen += connection.recv(4096)
            plan = self.begin_plan()
            while not re.search(rb"stop \d+\.[\d>]", seen):
                seen += connection.recv(4096)
        plan.send_signal(signal.SIGSTOP)
        worker = self.start_worker()
        # It hears of a client that is frozen for so long only.
        is_given_out = worker.lines.sees("begun", 4)
        plan.send_signal(signal.SIGCONT)
        self.end_plan(plan)
        worker.kill()
        return is_given_out

    def test_the_server_goes_and_comes_back(self):
        worker = self.start_worker()
        plan = self.begin_plan_with(worker)
        self.server.kill()
        self.server.wait()
        self.end_plan(plan)
        self.end_plan(self.begin_plan())
        self.assertIn("what they did not answer was solved here", self.error)
        self.start_server()
        worker.lines.wait_for("ready", 2)
        self.require_help()

    def test_a_frozen_server_holds_nobody_up(self):
        worker = self.start_worker()
        plan = self.begin_plan_with(worker)
        self.server.send_signal(signal.SIGSTOP)
        self.end_plan(plan)

    def test_a_server_that_freezes_before_it_is_asked_holds_nobody_up(self):
        self.generate("p", "--width", 900, "--height", 900, "--density", 0.1, "--agents", 200)
        with FreezingServer(self.host, self.port) as server:
            plan = self.begin_plan(f"nats://fleet:{PASSWORD}@{self.host}:{server.port}",
                                   words=("--solver", "ecbs", "--split", "40t"))
            _, error = plan.communicate(timeout=PATIENCE_S)
        self.assertEqual(plan.returncode, 0, error)
        self.assertTrue(server.frozen.is_set())

    def test_a_worker_of_another_version_gets_no_piece(self):
        with open(COMMAND, "rb") as file:
            program = file.read()
        names = set(re.findall(rb"\d+_\d+_\d+-[0-9a-f]{16}", program))
        self.assertEqual(len(names), 1)
        name = names.pop()
        with open(self.path("other"), "wb") as file:
            file.write(program.replace(name, name[:-16] + b"0" * 16))
        os.chmod(self.path("other"), 0o755)
        library = os.path.join(os.path.dirname(COMMAND), "..")
        worker = self.start_worker(self.path("other"),
                                   env=dict(os.environ, LD_LIBRARY_PATH=library))
        self.assertEqual(self.end_plan(self.begin_plan()), 0)
        self.assertIn("asked", self.error)
        self.assertEqual(worker.lines.count("begun"), 0)

    def test_a_stranger_is_refused(self):
        for who in ("", "fleet:wrong-word@"):
            result = self.run_command("worker", "--server", self.url(who))
            self.assertEqual(result.returncode, 1)
            self.assertIn(f"nats://{self.host}:{self.port}: Authentication", result.stderr)
            self.assertEqual(self.end_plan(self.begin_plan(self.url(who))), 0)
            self.assertIn("Authentication", self.error)
            self.assertNotIn("wrong-word", result.stderr + self.error)

    @unittest.skipUnless(shutil.which("openssl"), "no openssl to make a certificate")
    def test_the_connection_may_be_encrypted(self):
        self.server.kill()
        subprocess.run(
            ["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256",
             "-nodes", "-keyout", "key.pem", "-out", "cert.pem", "-days", "2", "-subj", "/CN=fleet",
             "-addext", f"subjectAltName=IP:{self.host}"],
            cwd=self.folder, check=True, stderr=subprocess.DEVNULL)
        self.start_server(more=f"tls {{ cert_file: \"{self.path('cert.pem')}\", "
                               f"key_file: \"{self.path('key.pem')}\" }}")
        url = self.url(scheme="tls")
        # Nobody whom we know signed it.
        result = self.run_command("worker", "--server", url)
        self.assertEqual((result.returncode, PASSWORD in result.stderr), (1, False), result.stderr)
        known = dict(os.environ, SSL_CERT_FILE=self.path("cert.pem"))
        self.start_worker(url=url, env=known)
        self.require_help(url, env=known)

    def test_a_poisoned_answer_counts_for_nothing(self):
        stop = threading.Event()
        poisoner = threading.Thread(target=self.poison, args=(stop,))
        poisoner.start()
        try:
            self.poisoned.wait(PATIENCE_S)
            self.assertEqual(self.end_plan(self.begin_plan()), 0)
            self.assertRegex(self.error, "[1-9][0-9]* pieces? asked, 0 answers")
        finally:
            stop.set()
            poisoner.join()

    poisoned = threading.Event()

    def poison(self, stop):
        """Somebody who knows the password and answers every question wrongly, at once."""
        answers = [b"x", b"ANSWER1", b"ANSWER1" + bytes(200), b"ANSWER1" + b"\xff" * 50,
                   # Solved, by one robot that stays in vertex 0; by 2^32 - 1 robots.
                   b"ANSWER1" + bytes(9) + b"\x01\x01\x01\x00",
                   b"ANSWER1" + bytes(9) + b"\x01\xff\xff\xff\xff\x0f\x01\x00"]
        with socket.create_connection((self.host, self.port)) as connection:
            connection.settimeout(0.1)
            hello = json.dumps({"verbose": False, "user": "fleet", "pass": PASSWORD})
            connection.sendall(f"CONNECT {hello}\r\nSUB split_mapf.pieces.> 1\r\nPING\r\n".encode())
            seen = b""
            while not stop.is_set():
                try:
                    seen += connection.recv(1 << 16)
                except socket.timeout:
                    continue
                if b"PONG" in seen:
                    self.poisoned.set()
                for subject in re.findall(rb"MSG split_mapf\.pieces\.[^ .]+\.(\S+) 1 ", seen):
                    for answer in [b""] + answers:
                        connection.sendall(b"PUB split_mapf.answers.%s %d\r\n%s\r\n"
                                           % (subject, len(answer), answer))
                seen = seen[-100:] if b"MSG split" not in seen[-100:] else b""

    def test_a_url_that_is_none_is_refused(self):
        for url in ("localhost", "http://h", "4222"):
            refusal = f"workers: '{url}' was given"
            self.expect_refusal(refusal, "plan", *self.files("p"), "--workers", url)
            self.expect_refusal(refusal, "worker", "--server", url)

    def test_a_worker_ends_when_it_is_told_to(self):
        worker = self.start_worker()
        plan = self.begin_plan_with(worker)
        worker.send_signal(signal.SIGTERM)
        self.assertEqual(worker.wait(PATIENCE_S), 0)
        self.end_plan(plan)


HAS_NAMESPACES = os.geteuid() == 0 and shutil.which("ip") and subprocess.run(
    ["unshare", "--net", "true"], stderr=subprocess.DEVNULL, check=False).returncode == 0


@unittest.skipUnless(HAS_NAMESPACES, "no network namespaces for this user")
class TwoMachinesTest(WorkersCase):
    """Server and worker in one network namespace, the plan in another, and a cable between them."""

    host = "10.213.0.2"

    def setUp(self):
        here, there = f"sm_{os.getpid()}_a", f"sm_{os.getpid()}_b"
        self.prefix = ("ip", "netns", "exec", there)
        self.plan_prefix = ("ip", "netns", "exec", here)
        for name in (here, there):
            self.ip("netns", "add", name)
            self.addCleanup(self.ip, "netns", "delete", name)
        self.ip("-n", here, "link", "add", "cable", "type", "veth", "peer", "name", "cable",
                "netns", there)
        for name, address in ((here, "10.213.0.1/24"), (there, self.host + "/24")):
            self.ip("-n", name, "address", "add", address, "dev", "cable")
            self.ip("-n", name, "link", "set", "cable", "up")
            self.ip("-n", name, "link", "set", "lo", "up")
        self.there = there
        super().setUp()

    @staticmethod
    def ip(*words):
        subprocess.run(["ip", *words], check=True, timeout=PATIENCE_S)

    def test_the_cable_is_cut_in_mid_piece_and_mended(self):
        worker = self.start_worker()
        self.require_help()
        plan = self.begin_plan_with(worker)
        self.ip("-n", self.there, "link", "set", "cable", "down")
        self.end_plan(plan)
        self.ip("-n", self.there, "link", "set", "cable", "up")
        # The kernel may take a moment until it finds the neighbour again.
        self.require_help()


if __name__ == "__main__":
    unittest.main()
