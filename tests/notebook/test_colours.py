"""What is shown can be read on light pages and on dark ones: contrasts as the WCAG reckon them (AA: 4.5 for text)."""

import re

import pytest

from casper.notebook.curves import COLOURS
from casper.notebook.markup import STYLE

PAGES = [("#222222", "#ffffff"), ("#dddddd", "#111111"), ("#e6e6e6", "#1e2129")]  # text and ground
HUES = dict(re.findall(r"--(share|good|bad|warn):(#[0-9a-f]{6})", STYLE))


def channels(colour):
    return [int(colour[at : at + 2], 16) / 255 for at in (1, 3, 5)]


def mixed(colour, part, other):
    return [part * a + (1 - part) * b for a, b in zip(channels(colour), channels(other))]


def luminance(colour):
    linear = [v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4 for v in colour]
    return sum(weight * value for weight, value in zip((0.2126, 0.7152, 0.0722), linear))


def contrast(a, b):
    dark, light = sorted((luminance(a), luminance(b)))
    return (light + 0.05) / (dark + 0.05)


@pytest.mark.parametrize(("text", "ground"), PAGES)
@pytest.mark.parametrize("hue", HUES)
def test_coloured_text_can_be_read(hue, text, ground):
    (part,) = set(re.findall(rf"color-mix\(in srgb,var\(--{hue}\) (\d+)%,currentColor\)", STYLE))
    assert contrast(mixed(HUES[hue], int(part) / 100, text), channels(ground)) >= 4.5


@pytest.mark.parametrize(("text", "ground"), PAGES)
def test_faint_text_can_be_read(text, ground):
    (part,) = re.findall(r"--faint:color-mix\(in srgb,currentColor (\d+)%,transparent\)", STYLE)
    assert contrast(mixed(text, int(part) / 100, ground), channels(ground)) >= 4.4


@pytest.mark.parametrize("colour", [*COLOURS, *HUES.values()])
@pytest.mark.parametrize(("text", "ground"), PAGES)
def test_lines_and_bars_stand_out(colour, text, ground):
    assert contrast(channels(colour), channels(ground)) >= 3
