"""SIGINT and SIGTERM end a call soon, and with the right exit code."""

import os
import signal
import time
import unittest

from command import OPTIMAL, PATIENCE_S, CommandTest

SOON_S = 1


class StopTest(CommandTest):
    def stop(self, process, number, delay_s):
        """Sends a signal after a delay; returns exit code, standard error and seconds taken."""
        time.sleep(delay_s)
        self.assertIsNone(process.poll(), "ended before the signal")
        begin = time.monotonic()
        process.send_signal(number)
        _, error = process.communicate(timeout=PATIENCE_S)
        return process.returncode, error, time.monotonic() - begin

    def expect_cancelled(self, number, *options):
        self.generate_hard("h")
        process = self.start("plan", *self.files("h"), "--output", "h.json", *OPTIMAL, *options)
        code, error, seconds = self.stop(process, number, delay_s=0.7)
        self.assertEqual(code, 4, error)
        self.assertLess(seconds, SOON_S)
        self.assertIn("cancelled", error)
        result = self.read_json("h.json")
        self.assertEqual((result["status"], result["agents"], result["paths"]),
                         ("cancelled", 250, []))

    def test_interrupt_during_the_search(self):
        self.expect_cancelled(signal.SIGINT)

    def test_termination_during_the_search(self):
        self.expect_cancelled(signal.SIGTERM, "--threads", 1)

    def test_interrupt_with_a_progress_line(self):
        self.expect_cancelled(signal.SIGINT, "--progress")

    def test_a_second_signal_changes_nothing(self):
        self.generate_hard("h")
        process = self.start("plan", *self.files("h"), "--output", "h.json", *OPTIMAL)
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=PATIENCE_S)
        self.assertEqual(process.returncode, 4)
        self.assertEqual(self.read_json("h.json")["status"], "cancelled")

    def test_interrupt_while_a_file_cannot_be_read(self):
        os.mkfifo(self.path("pipe.map"))  # nobody ever writes into it
        self.write("p.scen", "version 1\n")
        process = self.start("plan", "--map", "pipe.map", "--scen", "p.scen")
        code, error, seconds = self.stop(process, signal.SIGINT, delay_s=0.3)
        self.assertEqual(code, 4, error)
        self.assertLess(seconds, SOON_S)
        self.assertIn("reading", error)

    def test_the_time_limit_covers_reading(self):
        os.mkfifo(self.path("pipe.map"))
        self.write("p.scen", "version 1\n")
        begin = time.monotonic()
        result = self.expect(3, "plan", "--map", "pipe.map", "--scen", "p.scen", "--time-limit", 1)
        self.assertLess(time.monotonic() - begin, 3)
        self.assertIn("reading", result.stderr)


if __name__ == "__main__":
    unittest.main()
