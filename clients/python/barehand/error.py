"""The exception for problems outside of the program."""


class Error(Exception):
    """A file, a network or an argument cannot be used. Says what is wrong, where, and what to do about it."""

    def __init__(self, what, where="", remedy=""):
        super().__init__((f"{where}: " if where else "") + what + (f" ({remedy})" if remedy else ""))
        self.what, self.where, self.remedy = what, where, remedy
