"""Bad usage and bad input end at once with exit code 1 and say what was wrong."""

import os
import unittest

from command import CommandTest

COMMANDS = ["plan", "validate", "check", "convert", "generate", "render", "roadmap", "simulate",
            "solvers"]


class HelpTest(CommandTest):
    def test_help_and_version_work_everywhere(self):
        for command in [[]] + [[name] for name in COMMANDS]:
            text = self.expect(0, *command, "--help").stdout
            self.assertIn("Usage: split_mapf", text)
            self.assertRegex(self.expect(0, *command, "--version").stdout,
                             r"^split_mapf \d+\.\d+\.\d+\n$")

    def test_help_of_the_program_names_every_command(self):
        text = self.expect(0, "--help").stdout
        for name in COMMANDS:
            self.assertIn("\n  " + name + " ", text)

    def test_help_wins_over_missing_options(self):
        self.assertIn("--scen", self.expect(0, "plan", "--map", "none.map", "--help").stdout)

    def test_help_shows_every_option_of_plan_with_its_default(self):
        text = " ".join(self.expect(0, "plan", "--help").stdout.split())
        for option in ["--map FILE", "--scen FILE", "--agents N", "--solver-option NAME=VALUE",
                       "--split-option NAME=VALUE", "--memory-limit MIB",
                       "--table-memory MIB", "--paths FORM", "--output FILE",
                       "--progress", "--quiet"]:
            self.assertIn(option, text)
        for default in ["sum_of_costs (makespan)", "of ECBS (1.5)", "included (60)",
                        "randomness (0)"]:
            self.assertIn(default, text)

    def test_solvers_lists_solvers_options_and_defaults(self):
        text = self.expect(0, "solvers").stdout
        for part in ["ecbs\n", "prioritized\n", "order=shortest_first", "split options",
                     "variant=", "compaction=true"]:
            self.assertIn(part, text)


class BadUsageTest(CommandTest):
    def setUp(self):
        super().setUp()
        self.write_problem("p", ["..", ".."], [((0, 0), (1, 1))])

    def refuse_plan(self, parts, *options):
        self.expect_refusal(parts, "plan", *self.files("p"), "--output", "out.json", *options)
        self.assertFalse(os.path.exists(self.path("out.json")))

    def test_commands(self):
        self.expect_refusal(["no command", "plan, validate"])
        for name in ["plans", "help", "--frobnicate", ""]:
            self.expect_refusal([f"'{name}'", "plan, validate"], name)

    def test_unknown_options(self):
        for command in COMMANDS:
            self.expect_refusal(["--nonsense", command + " --help"], command, "--nonsense", "1")
        # No guessing from the beginning of a name, no short options, no stray arguments.
        self.refuse_plan("--agent", "--agent", "1")
        self.refuse_plan("-q", "-q")
        self.refuse_plan("'stray'", "stray")

    def test_an_option_given_twice(self):
        for option, value in [("--map", "p.map"), ("--agents", "1"), ("--solver", "ecbs"),
                              ("--split", "none"), ("--seed", "0"), ("--time-limit", "1")]:
            self.expect_refusal([option, "more than once"], "plan", *self.files("p"),
                                option, value, option, value)
        self.refuse_plan(["--quiet", "more than once"], "--quiet", "--quiet")

    def test_missing_options_and_values(self):
        self.expect_refusal("--scen", "plan", "--map", "p.map")
        self.expect_refusal("--map", "plan", "--scen", "p.scen")
        self.expect_refusal("--plan", "validate", *self.files("p"))
        self.expect_refusal("--output-scen", "generate", "--output-map", "x.map")
        self.refuse_plan("--seed", "--seed")
        self.refuse_plan("--seed", "--seed", "")
        self.refuse_plan("--quiet", "--quiet=yes")

    def test_values_out_of_range(self):
        for option, values in {
                "--agents": ["0", "-1", "1.5", "x", "4294967296"],
                "--suboptimality": ["0.9", "-1", "nan", "inf", "1.5x", "w"],
                "--time-limit": ["-1", "nan", "inf", "1s", "1e999"],
                "--memory-limit": ["0", "-5", "1.5"],
                "--table-memory": ["0", "-5", "1.5"],
                "--threads": ["0", "-1", "two", "1025"],
                "--seed": ["-1", "0x10", "18446744073709551616"],
                "--refine": ["-1", "x"]}.items():
            for value in values:
                self.refuse_plan([option, f"'{value}'"], option, value)

    def test_unknown_names(self):
        self.refuse_plan(["'best'", "ecbs"], "--solver", "best")
        self.refuse_plan(["'flowtime'", "makespan"], "--objective", "flowtime")
        self.refuse_plan(["'short'", "compact"], "--paths", "short")
        self.refuse_plan(["'nonsense'", "Ns | RxCs"], "--split", "nonsense")
        self.refuse_plan(["'speed'", "ecbs"], "--solver", "ecbs", "--solver-option", "speed=9")
        self.refuse_plan("order", "--solver", "prioritized", "--solver-option", "order=best")
        self.refuse_plan("'order'", "--solver-option", "order")
        self.refuse_plan("order", "--solver", "prioritized", "--solver-option", "order=random",
                         "--solver-option", "order=given")
        self.refuse_plan("'speed'", "--split", "2t", "--split-option", "speed=9")

    def test_options_that_would_have_no_effect(self):
        self.refuse_plan("--progress", "--progress", "--quiet")
        self.refuse_plan("none", "--split", "none", "--split-option", "variant=makespan")

    def test_options_of_a_solver_that_is_not_named(self):
        self.refuse_plan("auto", "--solver-option", "order=random")

    def test_output_that_cannot_be_written_is_refused_before_planning(self):
        self.expect_refusal("no/such/out.json", "plan", *self.files("p"),
                            "--output", "no/such/out.json")
        os.mkdir(self.path("folder"))
        self.expect_refusal("is a directory", "plan", *self.files("p"), "--output", "folder")


class BadInputTest(CommandTest):
    def setUp(self):
        super().setUp()
        self.write_problem("p", ["...", ".@.", "..."], [((0, 0), (2, 2)), ((2, 0), (0, 2))])

    def test_missing_files(self):
        self.expect_refusal("none.map", "plan", "--map", "none.map", "--scen", "p.scen")
        self.expect_refusal("none.scen", "plan", "--map", "p.map", "--scen", "none.scen")
        self.expect_refusal("none.json", "validate", *self.files("p"), "--plan", "none.json")

    def test_a_malformed_map_is_named_with_its_line(self):
        self.write("p.map", "type octile\nheight 3\nwidth 3\nmap\n...\n.?.\n...\n")
        self.expect_refusal("p.map:6", "plan", *self.files("p"))

    def test_too_few_rows_in_the_scenario(self):
        self.expect_refusal(["p.scen:4", "3"], "plan", *self.files("p"), "--agents", 3)

    def test_a_start_on_a_wall_is_named(self):
        self.write_problem("w", ["...", ".@.", "..."], [((0, 0), (2, 2)), ((1, 1), (0, 2))])
        self.expect_refusal(["robot 1", "(1,1)"], "plan", *self.files("w"))

    def test_every_robot_at_fault_is_named(self):
        self.write_problem("w", ["..."], [((0, 0), (2, 0)), ((0, 0), (1, 0)), ((1, 0), (2, 0))])
        self.expect_refusal(["robot 1: its start (0,0)", "robot 2: its goal (2,0)"], "plan",
                            *self.files("w"))

    def test_a_plan_file_that_holds_no_plan(self):
        self.write("e.json", '{"paths": []}')
        for command in [["validate"], ["render", "--output", "x.png"]]:
            self.expect_refusal(["e.json", "empty"], *command, *self.files("p"), "--plan", "e.json")

    def test_generate_refuses_what_cannot_be(self):
        def refuse(parts, *options):
            self.expect_refusal(parts, "generate", "--output-map", "g.map",
                                "--output-scen", "g.scen", *options)
            self.assertFalse(os.path.exists(self.path("g.map")))

        refuse(["17 robots", "16 cells"], "--width", 4, "--height", 4, "--density", 0,
               "--agents", 17)
        refuse("'maze'", "--type", "maze")
        refuse("density", "--density", 1)
        refuse("density", "--density", 0.2, "--type", "rooms")
        refuse("width", "--width", 40000)
        self.expect_refusal("same file", "generate", "--output-map", "g", "--output-scen", "g")


if __name__ == "__main__":
    unittest.main()
