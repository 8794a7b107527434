"""Counts of what arrived and of what could not be used."""
from dataclasses import dataclass, fields


@dataclass
class Counts:
    """Counts of the messages of a network or a log. Damaged or missing messages are counted, not replaced by made-up
    values."""

    messages: int = 0      #: hand messages that were decoded
    lost: int = 0          #: messages on any channel that were sent but never arrived
    fragments: int = 0     #: large messages of which a fragment never arrived
    damaged: int = 0       #: messages, datagrams or parts of a log that could not be read
    foreign: int = 0       #: messages of other types on the channels of hand states
    incomplete: int = 0    #: hands for which not all three messages arrived; the missing values are NaN
    superseded: int = 0    #: frames that were skipped because newer ones had arrived (`newest=True`)

    def trouble(self):
        """A text that lists the problems and their counts; empty if there were none."""
        names = [field.name for field in fields(self) if field.name not in ("messages", "superseded")]
        return ", ".join(f"{getattr(self, name)} {name}" for name in names if getattr(self, name))
