"""What is wrong with input, as exceptions. All of them are ValueErrors; the text of each says what
was given, where, and what was expected."""

import collections

Fault = collections.namedtuple("Fault", "robot cell kind message")
Fault.__doc__ = """Why one robot cannot be planned for: its index; its start or goal (x, y) that is at
fault; outside_map, blocked_cell, duplicate_start or duplicate_goal; and a sentence."""


class InputError(ValueError):
    """Bad input: a file, an array, a number."""


class OptionError(InputError):
    """An unknown option, or a value out of range."""


class UnknownSolverError(OptionError):
    """A name of a solver that there is not."""


class SplitSpecError(OptionError):
    """A split that is none."""


class InstanceError(InputError):
    """Robots that cannot be planned for: all of them in `faults`, the first in `robot` and `cell`."""

    def __init__(self, message, faults):
        super().__init__(message, faults)
        self.faults = list(faults)
        self.robot = self.faults[0].robot
        self.cell = self.faults[0].cell

    def __str__(self):
        return self.args[0]
