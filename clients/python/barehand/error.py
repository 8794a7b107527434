"""The exception for problems outside of the program."""


class Error(Exception):
    """The error for a file, a network or an argument that cannot be used: what is wrong, where, and what to do."""

    def __init__(self, what, where="", remedy=""):
        super().__init__((f"{where}: " if where else "") + what + (f" ({remedy})" if remedy else ""))
        self.what, self.where, self.remedy = what, where, remedy
