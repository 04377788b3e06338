"""``pytest --casper-domain FOLDER``: a domain's laws and examples as tests, without a line of Python.

Nothing heavy is imported until the option is given. Each law and each example is a test, named after it; a profile of
examples is chosen by ``--casper-profile``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import pytest

OPTION = "--casper-domain"
FOLDERS = pytest.StashKey[dict[Path, str]]()  # of the domains that are held to the laws, by what they were called


def pytest_addoption(parser: pytest.Parser) -> None:
    """The options."""
    group = parser.getgroup("casper", "laws of a CASPER domain")
    help_ = "hold this domain (a folder or a shipped name) to its examples and the laws"
    group.addoption(OPTION, action="append", default=[], metavar="DIR", help=help_)
    help_ = "how many examples of each law: quick, standard or thorough"
    group.addoption("--casper-profile", default=None, metavar="NAME", help=help_)


def pytest_configure(config: pytest.Config) -> None:
    """Choose the profile, and have the domains' folders collected with what is collected anyway."""
    config.stash[FOLDERS] = {}
    if not (config.getoption(OPTION) or config.getoption("--casper-profile")):
        return
    from casper.engine.domain.domain import find_domain
    from casper.kb.errors import CasperError
    from casper.testing.profiles import load_profile

    try:
        load_profile(config.getoption("--casper-profile"))
        for name in config.getoption(OPTION):
            folder = Path(find_domain(name)).resolve()
            config.stash[FOLDERS][folder] = name
            config.args.append(str(folder))
    except CasperError as mistake:
        raise pytest.UsageError(str(mistake)) from None


@pytest.hookimpl(tryfirst=True)
def pytest_collect_directory(path: Path, parent: pytest.Collector) -> pytest.Collector | None:
    """A domain's folder holds its laws and examples, and whatever tests are in it besides."""
    if path.resolve() not in parent.config.stash[FOLDERS]:
        return None
    found: pytest.Collector = DomainFolder.from_parent(parent, path=path)
    return found


class DomainFolder(pytest.Dir):  # type: ignore[misc]  # it is marked final
    """The folder of a domain."""

    def collect(self) -> Iterator[pytest.Item | pytest.Collector]:
        """The tests of the domain, then those of its files."""
        yield from _tests_of(self, self.path)
        yield from super().collect()


class DomainItem(pytest.Item):
    """One thing that must hold of a domain."""

    def __init__(self, *, check: Callable[[], None], place: tuple[Path, int | None], **named: Any) -> None:
        super().__init__(**named)
        self.check, self.place = check, place

    def runtest(self) -> None:
        """Hold the domain to it."""
        from casper.testing.laws import NotApplicable

        try:
            self.check()
        except NotApplicable as reason:
            pytest.skip(str(reason))

    def repr_failure(self, failed: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        """What is wrong, without our own code."""
        from casper.kb.errors import CasperError

        if isinstance(failed.value, (AssertionError, CasperError)):
            notes = [note for note in getattr(failed.value, "__notes__", ()) if not note.startswith("Falsifying")]
            return "\n".join([str(failed.value), *notes])
        return super().repr_failure(failed)

    def reportinfo(self) -> tuple[Path, int | None, str]:
        """Where it stands."""
        return self.place[0], self.place[1], self.name


def _tests_of(parent: DomainFolder, folder: Path) -> Iterator[DomainItem]:
    from casper.engine.domain.domain import Domain
    from casper.engine.domain.examples import TESTS, examples_of, failure
    from casper.kb.errors import CasperError
    from casper.sim_adapter.checking import check_whole
    from casper.testing.laws import LAWS

    def made(name: str, check: Callable[[], None], file: Path = folder, line: int | None = None) -> DomainItem:
        item: DomainItem = DomainItem.from_parent(parent, name=name, check=check, place=(file, line))
        return item

    try:
        domain, examples = Domain.load(folder), examples_of(folder)
    except CasperError as mistake:
        yield made("loads", partial(_refuse, mistake))
        return
    yield made("check", lambda: _checked(check_whole(folder)))
    for example in examples:
        tried = partial(_tried, failure, domain, example)
        yield made(f"example {example}", tried, folder / TESTS, example.place.line - 1)
    for law in LAWS:
        yield made(law.name, partial(law.check, domain))


def _checked(findings: Any) -> None:
    bad = [str(finding) for finding in findings if finding.severity != "note"]
    assert not bad, "\n".join(bad)


def _tried(failure: Callable[..., str | None], domain: Any, example: Any) -> None:
    wrong = failure(domain, example)
    assert wrong is None, wrong


def _refuse(mistake: Exception) -> None:
    raise mistake
