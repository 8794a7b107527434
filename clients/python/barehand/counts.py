"""Counts of what arrived and of what could not be used."""
from dataclasses import dataclass, fields


@dataclass
class Counts:
    """What a network or a log brought. Nothing that is damaged or missing is replaced by invented values; it is counted."""

    messages: int = 0      #: hand messages that were decoded
    lost: int = 0          #: messages that a sender sent and that never arrived, on any channel
    fragments: int = 0     #: large messages of which a fragment never arrived
    damaged: int = 0       #: messages, datagrams or stretches of a log that could not be read
    foreign: int = 0       #: messages of other types on the channels of hand states
    incomplete: int = 0    #: hands of which not all three messages arrived: what is missing is NaN
    superseded: int = 0    #: frames that were passed over for newer ones (`newest=True`)

    def trouble(self):
        """What did not arrive well, in words; empty if all did."""
        names = [field.name for field in fields(self) if field.name not in ("messages", "superseded")]
        return ", ".join(f"{getattr(self, name)} {name}" for name in names if getattr(self, name))
