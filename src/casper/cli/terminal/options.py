"""Arguments and options that several commands share."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def _domains(incomplete: str) -> list[str]:
    """The shipped domains, and the folders that hold one, for completion in a shell."""
    from casper.cli.terminal.completing import domains

    return domains(incomplete)


def _policies(incomplete: str) -> list[str]:
    return [name for name in ("strict", "best") if name.startswith(incomplete)]


def bodies(incomplete: str) -> list[str]:
    """The bodies of the simulated robot that begin so; the simulator is not loaded for that."""
    return [name for name in ("primitive", "tiago") if name.startswith(incomplete)]


DomainName = Annotated[
    str,
    typer.Argument(help="A shipped domain (kitchen) or the folder of one.", metavar="DOMAIN", autocompletion=_domains),
]
AsJson = Annotated[bool, typer.Option("--json", help="Print one JSON object a line.")]
Unverified = Annotated[bool, typer.Option("--no-verification", help="Never ask the knowledge base about observations.")]
PolicyName = Annotated[
    str, typer.Option("--policy", help="When to commit to a goal: strict or best.", autocompletion=_policies)
]
Noise = Annotated[
    float | None,
    typer.Option("--noise", metavar="PRICE", help="Allow needless actions: the factor each one multiplies a score by."),
]
Certainty = Annotated[
    float | None,
    typer.Option("--certainty", metavar="P", help="Act on a goal only if it is so sure, from 0 (at once) to 1."),
]
Goals = Annotated[int, typer.Option("--goals", metavar="N", help="How many goals may be pursued at once.")]
Stops = Annotated[bool, typer.Option("--stop", help="Stop at an action that fits no plan, instead of leaving it out.")]
Language = Annotated[
    str | None,
    typer.Option("--language", metavar="L", help="Tell reasons in this language, as far as the domain words them: fr."),
]
Report = Annotated[
    Path | None,
    typer.Option("--report", metavar="FILE.html", help="Write a page to look at: what happened, played back, and why."),
]
Rerun = Annotated[
    Path | None,
    typer.Option("--rerun", metavar="FILE.rrd", help="Record it for Rerun's viewer, on one time line (needs [rerun])."),
]
Robot = Annotated[
    str,
    typer.Option(
        "--robot",
        metavar="BODY",
        help="The simulated robot's body: primitive, or tiago (TIAGo++ itself, once its model is installed).",
        autocompletion=bodies,
    ),
]
Quiet = Annotated[bool, typer.Option("--quiet", help="Print results only: no progress, no hints, of run the summary.")]
SourceName = Annotated[
    str, typer.Argument(help="Where world states come from: - (standard input), a file (.gz, too), tcp://HOST:PORT.")
]
Window = Annotated[
    float | None,
    typer.Option(metavar="S", help="Put in order what comes up to S seconds late (usually 1 in a file, else 0)."),
]
Listens = Annotated[bool, typer.Option("--listen", help="Wait at tcp://HOST:PORT for somebody to connect.")]
Reconnect = Annotated[
    float,
    typer.Option(metavar="S", min=0, help="Wait S seconds for a connection that is not there, or ended; 0: do not."),
]
Record = Annotated[
    Path | None, typer.Option("--record", metavar="FILE", help="Keep what the minds take in, for casper replay.")
]
Speed = Annotated[float, typer.Option(help="Seconds of the stream a second: 1 is as it was, 0 as fast as it goes.")]
