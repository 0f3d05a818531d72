"""What can go wrong, as exceptions with the texts of the program."""


class InputError(ValueError):
    """Bad input: one message that names file, line, key and what was expected. Nothing was written.

    `file`, `line` (0: none) and `key` say where it stands.
    """

    def __init__(self, message, file="", line=0, key=""):
        super().__init__(message)
        self.file, self.line, self.key = file, line, key


class Refused(ValueError):
    """What was handed to the contact library cannot be used; the text says what was expected."""


class AnalysisFailed(RuntimeError):
    """The analysis stopped before its end. `result` has everything that converged."""

    def __init__(self, message, result=None):
        super().__init__(message)
        self.result = result


class Interrupted(KeyboardInterrupt):
    """Ctrl-C ended the analysis after an iteration. `result` has everything that converged."""

    def __init__(self, message, result=None):
        super().__init__(message)
        self.result = result
