"""Folders that hold what no domain holds: pipes, devices, circles of links. Nothing is waited for, nothing ignored."""

import os

import pytest

from casper.engine.domain.check import check_domain
from casper.engine.domain.domain import FILES, Domain
from casper.engine.domain.reload import current_fingerprint, reloaded
from casper.engine.live import Live
from casper.engine.mind import Mind
from casper.kb.errors import CasperError, DomainError

pytestmark = pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this platform has no pipes with a name")

ONTOLOGY = "human(ann).\nwave(A) :- human(A).\n"
PLANS = "goal(greet).\ngreet --> wave.\n"
KINDS = {
    "a pipe": os.mkfifo,
    "a folder": os.mkdir,
    "a device": lambda path: os.symlink("/dev/zero", path),
    "a circle of links": lambda path: os.symlink(path, path),
    "a link to nothing": lambda path: os.symlink("gone", path),
}


@pytest.fixture
def home(tmp_path):
    (tmp_path / "ontology.pl").write_text(ONTOLOGY)
    (tmp_path / "plans.pl").write_text(PLANS)
    return tmp_path


@pytest.mark.parametrize("file", FILES)
@pytest.mark.parametrize("kind", KINDS)
def test_a_file_that_is_none_is_refused_and_never_left_out(home, file, kind):
    (home / file).unlink(missing_ok=True)
    KINDS[kind](home / file)
    with pytest.raises(DomainError) as told:
        Domain.load(home)
    assert str(told.value) == f"cannot read {home / file} (it is {kind}, and only regular files are read)"
    sentences = [f.message for f in check_domain(home) if f.place.file == str(home / file)]
    assert f"this file cannot be read (it is {kind}, and only regular files are read)" in sentences


@pytest.mark.parametrize("kind", KINDS)
def test_it_is_no_empty_folder_either(tmp_path, kind):
    KINDS[kind](tmp_path / "ontology.pl")
    with pytest.raises(DomainError, match=f"it is {kind}"):
        Domain.load(tmp_path)


@pytest.mark.parametrize("name", ["/dev/zero", "/dev/null", "x" * 5000, "a\0b", "gone/gone"])
def test_what_is_no_folder_is_no_domain(name):
    with pytest.raises(DomainError, match="there is no domain"):
        Domain.load(name)
    with pytest.raises(DomainError, match="there is no domain"):
        check_domain(name)


def test_a_folder_of_links_to_itself_is_a_domain_like_any_other(home):
    (home / "again").symlink_to(home)
    (home / "scene.pl").write_text(':- include("again/again/more.pl").')
    (home / "more.pl").write_text("cup(mug).")
    assert Domain.load(home / "again" / "again").kb.ask("cup(mug)")
    (home / "round").symlink_to("round")
    with pytest.raises(DomainError, match="there is no domain"):
        Domain.load(home / "round")


@pytest.mark.parametrize("kind", KINDS)
def test_a_file_that_becomes_none_leaves_the_domain_in_force(home, kind):
    domain = Domain.load(home)
    (home / "plans.pl").unlink()
    KINDS[kind](home / "plans.pl")
    assert current_fingerprint(domain) != domain.fingerprint
    with pytest.raises(CasperError, match=f"it is {kind}"):
        reloaded(domain)


@pytest.mark.parametrize("kind", KINDS)
def test_a_running_mind_tells_it_once_and_goes_on(tmp_path, kind):
    for file in FILES:
        (tmp_path / file).write_text((Domain.load("kitchen").folder / file).read_text())
    live = Live(Mind(Domain.load(tmp_path)))
    (tmp_path / "plans.pl").unlink()
    KINDS[kind](tmp_path / "plans.pl")
    (message,) = live.refresh()
    assert f"the changed domain is not taken: cannot read {tmp_path / 'plans.pl'} (it is {kind}" in message
    assert live.refresh() == ()


# --- texts from outside ---------------------------------------------------------------------------------------------


@pytest.fixture
def secret(tmp_path):
    path = tmp_path / "secret.pl"
    path.write_text("good(hunter1).\nhunter2 hunter2.\nhunter3(X) :- hunter4(X).\n")
    return path


@pytest.mark.parametrize("way", ['include("../secret.pl")', 'use("../secret.pl", as(s))', 'include("link.pl")'])
def test_of_a_file_outside_that_cannot_be_read_no_check_shows_anything(home, secret, way, casper_check):
    folder = home / "home"
    folder.mkdir()
    (folder / "link.pl").symlink_to(secret)
    (folder / "ontology.pl").write_text(f":- {way}.\n{ONTOLOGY}")
    findings = check_domain(folder)
    assert [f.place.line for f in findings if "does not belong here" in f.message] == [2]
    assert not any("hunter" in f.message for f in findings)
    assert "hunter" not in casper_check(folder)


def test_a_file_of_the_domain_that_is_a_link_out_of_it_is_a_file_outside(home, secret, casper_check):
    (home / "home").mkdir()
    (home / "home" / "ontology.pl").symlink_to(secret)
    assert "hunter" not in casper_check(home / "home")
    with pytest.raises(CasperError) as told:
        Domain.load(home / "home")
    assert "ontology.pl:2:9: something does not belong here" in str(told.value)
    assert "hunter" not in str(told.value)


def test_of_a_file_outside_that_can_be_read_mistakes_are_told_without_the_line(home, casper_check):
    (home / "shared.pl").write_text("odd(X, Y) :- human(X).\n")
    (home / "home").mkdir()
    (home / "home" / "ontology.pl").write_text(f':- include("../shared.pl").\n{ONTOLOGY}tall(X, Y) :- human(X).\n')
    shown = casper_check(home / "home")
    assert "shared.pl:1: warning" in shown
    assert "odd(X, Y) :- human(X)." not in shown
    assert "    tall(X, Y) :- human(X)." in shown


@pytest.fixture
def casper_check(capsys, monkeypatch):
    """What ``casper check`` shows of a folder."""

    def call(folder):
        import sys

        from casper.cli import main

        monkeypatch.setattr(sys, "argv", ["casper", "check", str(folder)])
        with pytest.raises(SystemExit):
            main()
        captured = capsys.readouterr()
        return captured.out + captured.err

    return call
