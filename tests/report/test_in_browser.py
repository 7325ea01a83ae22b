"""The page as a reader has it, in Chromium, from its file."""

from time import monotonic

import pytest

from railcosim.figures.style import BLUE
from railcosim.report.histories import history_plots
from railcosim.report.page import write_page
from railcosim.report.palette import DARK
from railcosim.report.step_log import step_log_plots

pytestmark = pytest.mark.xdist_group("browser")  # one browser is enough

DRAWN = """key => [...document.querySelectorAll(
    `#${key} .js-line, #${key} .points path, #${key} .bars path`
)].filter(path => path.getAttribute('d').length > 5).length"""
PICTURE = "document.getElementById('scene').toDataURL()"
CHART = "document.getElementById('force-chart').toDataURL()"
RANGES = """() => [...document.querySelectorAll('.plot')].map(plot => plot._fullLayout.xaxis)
    .filter(axis => axis.title.text && axis.title.text.match(/distance|time/))
    .map(axis => axis.range.map(Number))"""
PHONE = {"viewport": {"width": 390, "height": 844}, "is_mobile": True, "has_touch": True}


@pytest.fixture(scope="module")
def tab(opened):
    """Give most tests the same page, since it takes seconds to load."""
    with opened() as tab:
        yield tab


def until(tab, condition, seconds=20.0):
    """Wait for a condition; Playwright's own way evaluates texts, which the page forbids."""
    end = monotonic() + seconds
    while not tab.evaluate(condition):
        assert monotonic() < end, condition
        tab.wait_for_timeout(20)


def frame_of(tab):
    return int(tab.locator("#moment").input_value())


def test_every_figure_is_drawn_with_all_its_curves(tab, passage):
    plots = [*history_plots(passage), *step_log_plots(passage)]
    assert len(plots) == 11
    for plot in plots:
        assert tab.evaluate(DRAWN, plot.key) >= len(plot.figure.data), plot.key
    loss = tab.locator("#contact-force .shapelayer path, #contact-force .layer-below path")
    assert loss.count() >= 2  # where the wheel is off the rail, and the flat's place


def test_the_animation_plays_and_pauses(tab):
    play = tab.locator("#play")
    first, chart, reading = tab.evaluate(PICTURE), tab.evaluate(CHART), text_of(tab, "#reading")
    play.click()
    assert play.inner_text() == "Pause"
    until(tab, "Number(document.getElementById('moment').value) > 2")
    played = frame_of(tab)
    until(tab, f"Number(document.getElementById('moment').value) > {played + 2}")
    play.click()
    assert play.inner_text() == "Play"
    assert tab.evaluate(PICTURE) != first
    assert tab.evaluate(CHART) != chart
    assert text_of(tab, "#reading") != reading
    paused, frame = tab.evaluate(PICTURE), frame_of(tab)
    tab.wait_for_timeout(300)
    assert (tab.evaluate(PICTURE), frame_of(tab)) == (paused, frame)


def text_of(tab, selector):
    return tab.locator(selector).inner_text()


def test_the_animation_goes_to_its_end_and_starts_again(tab):
    slider = tab.locator("#moment")
    last = int(slider.get_attribute("max"))
    tab.locator("#slowness").select_option("20")
    slider.fill(str(last - 4))
    assert "one second here is 50 ms" in text_of(tab, "#reading")
    tab.locator("#play").click()
    until(tab, "document.getElementById('play').textContent === 'Play'")
    assert frame_of(tab) == last
    tab.locator("#play").click()
    until(tab, f"Number(document.getElementById('moment').value) < {last}")
    tab.locator("#play").click()


def test_the_slider_shows_the_moment_without_contact(tab, passage):
    wheel = passage.sel(wheel=1)
    time = float(passage["time"][int(wheel["gap"].argmax("time"))])
    start = float(passage["time"][0])
    data = tab.evaluate(
        "({ rate: report.animation.rate, first: unpack(report.animation.time)[0] })"
    )
    tab.locator("#moment").fill(str(round((time - data["first"]) * data["rate"])))
    assert "wheel 1: 0.0 kN" in text_of(tab, "#reading")
    assert start <= data["first"] < time


def test_figures_share_their_horizontal_axis(tab):
    tab.evaluate("Plotly.relayout('gap', {'xaxis.range': [0.1, 0.2]})")
    until(tab, f"({RANGES})().every(([a, b]) => a === 0.1 && b === 0.2)")
    assert len(tab.evaluate(RANGES)) == 9
    tab.get_by_label("around the strike").check()
    tab.get_by_label("whole run").check()
    low, high = zip(*tab.evaluate(RANGES), strict=True)
    assert max(low) == pytest.approx(-0.6, abs=1e-3)
    assert min(high) == pytest.approx(1.05, abs=1e-3)
    tab.locator("input[value=time]").check()
    low, high = zip(*tab.evaluate(RANGES), strict=True)
    assert max(low) >= -1e-6
    assert min(high) == pytest.approx(1.65 / (40 / 3.6), rel=1e-3)


def test_no_button_sends_the_data_away(tab):
    tab.locator("#contact-force").hover()
    buttons = tab.locator("#contact-force .modebar-btn")
    titles = buttons.evaluate_all("all => all.map(one => one.dataset.title)")
    assert titles == ["Download plot", "Zoom", "Pan", "Zoom in", "Zoom out"]


def test_it_can_be_printed(tab):
    assert tab.pdf().startswith(b"%PDF")
    assert tab.evaluate(DRAWN, "contact-force") > 0


def test_a_dark_page_has_its_own_colours_and_paper_has_none_of_them(opened):
    stroke = "document.querySelectorAll('#gap .js-line')[0].style.stroke"
    with opened(color_scheme="dark") as tab:
        assert tab.evaluate(stroke) == rgb(DARK[BLUE])
        assert "Light" in text_of(tab, "#theme")
        tab.emulate_media(media="print")
        until(tab, f"{stroke} === '{rgb(BLUE)}'")
        tab.emulate_media(media="screen")
        until(tab, f"{stroke} === '{rgb(DARK[BLUE])}'")
        tab.locator("#theme").click()
        until(tab, f"{stroke} === '{rgb(BLUE)}'")


def rgb(colour):
    return f"rgb({', '.join(str(int(colour[k : k + 2], 16)) for k in (1, 3, 5))})"


def test_a_phone_shows_all_of_it_without_scrolling_sideways(opened):
    with opened(**PHONE) as tab:
        assert tab.evaluate("document.documentElement.scrollWidth") == 390
        assert tab.evaluate("document.getElementById('scene').clientWidth") > 300
        tab.locator("#play").tap()
        until(tab, "Number(document.getElementById('moment').value) > 2")


def test_everything_has_a_name_for_those_who_cannot_see_it(tab):
    unnamed = "button, input, select, canvas, .plot"
    names = tab.locator(unnamed).evaluate_all(
        "all => all.map(one => one.ariaLabel || one.innerText || one.labels?.[0]?.innerText)"
    )
    assert all(names)
    assert len(names) > 15


def test_markup_in_texts_of_the_passage_does_nothing(opened, passage):
    evil = "</script><script>alert(1)</script><img src=x onerror=alert(2)>"
    changed = passage.assign_attrs(warnings=evil, unreliable=evil, versions=evil)
    with opened(write_page(changed)) as tab:
        assert text_of(tab, "main").count(evil) == 3
