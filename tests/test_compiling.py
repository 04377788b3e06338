"""The hook that compiles a wheel: when it does, and what it says when it cannot."""

import importlib.util
from pathlib import Path
from types import SimpleNamespace

import pytest

ROOT = Path(__file__).resolve().parent.parent
pytest.importorskip("hatchling", reason="wheels are built with hatchling")


@pytest.fixture
def hook(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> SimpleNamespace:
    """The hook's file, a hook for no sources, and what it said; nothing is really compiled."""
    spec = importlib.util.spec_from_file_location("hatch_build", ROOT / "hatch_build.py")
    assert spec is not None and spec.loader is not None
    file = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(file)
    said: list[str] = []

    def abort(sentence: str) -> None:
        said.append(sentence)
        raise SystemExit(1)

    app = SimpleNamespace(abort=abort, display_warning=said.append)
    made = file.Compiling(str(tmp_path), {"modules": ["mind"]}, SimpleNamespace(sources={}), None, "", "wheel", app)
    compiled: list[list[str]] = []
    monkeypatch.setattr(file, "compile_in_place", compiled.append)
    monkeypatch.setenv("CASPER_COMPILE", "1")
    return SimpleNamespace(file=file, hook=made, said=said, compiled=compiled)


def test_nothing_is_compiled_unless_it_is_asked_for(hook, monkeypatch):
    monkeypatch.setenv("CASPER_COMPILE", "0")
    hook.hook.initialize("standard", {})
    assert hook.compiled == [] and hook.hook.dependencies() == []


def test_a_wheel_that_is_asked_for_is_compiled_and_is_for_one_platform(hook):
    data = {"force_include": {}}
    hook.hook.initialize("standard", data)
    assert hook.compiled == [["casper/mind.py"]]
    assert data == {"force_include": {}, "pure_python": False, "infer_tag": True}


def test_an_editable_install_is_not_compiled_and_says_so(hook):
    hook.hook.initialize("editable", {})
    assert hook.compiled == [] and "an editable install is not compiled" in hook.said[0]


def test_where_nothing_compiles_it_says_how_to_go_on(hook, monkeypatch):
    def fails(files):
        raise OSError("no cc")

    monkeypatch.setattr(hook.file, "compile_in_place", fails)
    with pytest.raises(SystemExit):
        hook.hook.initialize("standard", {"force_include": {}})
    assert hook.said == ["casper could not be compiled (no cc); without CASPER_COMPILE it is installed as it is"]
