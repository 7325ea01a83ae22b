"""The page as a text."""

import json
import re
from base64 import b64decode, b64encode
from hashlib import sha256
from html.parser import HTMLParser

import numpy as np
import pytest

from railcosim.evaluation.rail_shape import rail_shape
from railcosim.report.convergence import study
from railcosim.report.embedding import inline_data, inline_script
from railcosim.report.page import write_page
from railcosim.report.plot import thinned
from railcosim.scenario_file import from_toml, to_toml
from railcosim.summary import CAUSES, summarise
from railcosim.summary_lines import effort_lines, result_lines

VOID = {"meta", "link", "input", "img", "br"}


class Reader(HTMLParser):
    """Collects elements and texts, and insists that every element is closed where it should be."""

    def __init__(self):
        super().__init__()
        self.open, self.elements, self.texts, self.scripts = [], [], [], []

    def handle_starttag(self, tag, attrs):
        self.elements.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)
        if tag == "script":
            self.scripts.append("")

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if self.open and self.open[-1] == "script":
            self.scripts[-1] += data
        else:
            self.texts.append(data)

    @property
    def text(self):
        return " ".join(" ".join(self.texts).split())

    def values(self, attribute):
        return [attrs[attribute] for _, attrs in self.elements if attribute in attrs]


def read(page):
    reader = Reader()
    reader.feed(page)
    reader.close()
    assert reader.open == []
    return reader


@pytest.fixture(scope="module")
def reader(page):
    return read(page)


@pytest.fixture(scope="module")
def data(reader):
    return json.loads(next(text for text in reader.scripts if text.startswith("{")))


def unpacked(array):
    return np.frombuffer(b64decode(array["bdata"]), dtype="<f4")


def test_it_is_well_formed_and_its_names_lead_somewhere(reader):
    names = reader.values("id")
    assert len(names) == len(set(names))
    targets = [
        t for key in ("aria-labelledby", "aria-describedby", "for") for t in reader.values(key)
    ]
    links = [link[1:] for link in reader.values("href") if link.startswith("#")]
    assert {*targets, *links} <= set(names)
    assert [tag for tag, _ in reader.elements].count("h1") == 1
    assert ("html", {"lang": "en"}) in reader.elements


def test_it_needs_nothing_else(page, reader):
    assert reader.values("src") == []
    assert {link[:1] for link in reader.values("href")} <= {"#", "d"}
    assert [link for link in reader.values("href") if link[0] == "d"] == ["data:,"]
    assert len(page.encode()) < 8e6


def test_only_its_own_scripts_may_run(reader):
    (policy,) = (a["content"] for _, a in reader.elements if a.get("http-equiv"))
    digests = [
        b64encode(sha256(text.encode()).digest()).decode()
        for text in reader.scripts
        if not text.startswith("{")
    ]
    assert len(digests) == 7
    assert re.findall(r"'sha256-([^']+)'", policy) == digests
    assert "default-src 'none'" in policy
    assert "http" not in policy
    assert [name for _, attrs in reader.elements for name in attrs if name.startswith("on")] == []


def test_all_numbers_are_there(reader, passage):
    summary = summarise(passage)
    for line in (*result_lines(summary), *effort_lines(summary)):
        assert f"{line.what.strip()} {line.value}" in reader.text
    assert summary.loss_of_contact_time > 0.0


def test_it_says_what_was_run_and_by_what(reader, passage):
    assert "40 km/h, haversine 100 mm x 2 mm flat on wheel 1, state-dependent track" in reader.text
    assert "2 wheels, 1.8 m apart, of 592.5 kg under 117.72 kN each roll at 40 km/h" in reader.text
    for name in ("source", "versions", "track_fmu_guid", "vehicle_fmu_guid"):
        assert passage.attrs[name] in reader.text
    assert " ".join(passage.attrs["scenario"].split()) in reader.text


def test_the_curves_are_those_of_the_result(data, passage):
    forces = next(plot for plot in data["plots"] if plot["key"] == "contact-force")
    curves = {curve["name"]: unpacked(curve["y"]) for curve in forces["data"]}
    wheel = 1e-3 * passage["contact_force"].sel(wheel=2).to_numpy()
    assert curves["wheel 2"] == pytest.approx(wheel, rel=1e-6)
    axis = unpacked(data["axes"]["passage"]["distance"])
    assert axis == pytest.approx(passage["distance"].to_numpy(), abs=1e-6)
    assert len(forces["bands"]["distance"]) == len(forces["bands"]["time"]) > 0


def test_the_step_log_is_complete(data, passage):
    plots = {plot["key"]: plot for plot in data["plots"]}
    (bars,) = plots["rejections"]["data"]
    assert bars["y"] == [passage.attrs[f"steps_rejected_{cause}"] for cause in CAUSES]
    (bars,) = plots["iterations"]["data"]
    assert sum(bars["y"]) == passage.sizes["attempt"]
    assert np.dot(bars["x"], bars["y"]) == passage.attrs["iterations"]
    sizes = np.nanmax([unpacked(curve["y"]) for curve in plots["step-size"]["data"]], axis=0)
    assert sizes == pytest.approx(1e6 * passage["attempt_step_size"].to_numpy(), rel=1e-6)


def test_the_animation_shows_the_rail_of_the_passage(data, passage):
    show = data["animation"]
    assert show["rate"] == pytest.approx(2000.0, rel=0.01)
    times, places = unpacked(show["time"]), unpacked(show["railX"])
    rail = unpacked(show["rail"]).reshape(show["frames"], -1)
    assert (places[0], places[-1]) == pytest.approx((13.6, 19.6))
    frame = show["frames"] // 2
    exact = rail_shape(passage, [float(times[frame])], places[::20]).to_numpy()[0]
    assert rail[frame, ::20] == pytest.approx(1e3 * exact, abs=2e-4)  # float32 times
    assert unpacked(show["curveForce"]).max() == pytest.approx(
        1e-3 * float(passage["contact_force"].max())
    )


def test_the_same_result_gives_the_same_page(page, passage):
    assert write_page(passage) == page


def test_texts_of_the_user_stay_texts(passage):
    evil = "<script>alert(1)</script>&amp;'\""
    scenario = from_toml(passage.attrs["scenario"])
    named = to_toml(scenario).replace('"haversine"', json.dumps("/a/<script>b.csv"))
    reader = read(write_page(passage.assign_attrs(scenario=named, warnings=evil)))
    assert len(reader.scripts) == 8
    assert evil in reader.text
    assert "the measured flat of /a/<script>b.csv" in reader.text


def test_what_is_wrong_stands_before_the_numbers(passage):
    half = passage.isel(time=slice(0, 50))
    changed = half.assign_attrs(
        complete=0, stop_reason="it was interrupted", unreliable="It only jumps about."
    )
    text = read(write_page(changed)).text
    before, _, after = text.partition("Numbers Animation")[2].partition("largest contact force")
    assert "The run ended early" in before
    assert "it was interrupted." in before
    assert "It only jumps about." in before
    assert "not reached" in after
    assert "before there was anything to show" in after


def test_nothing_in_embedded_texts_ends_their_element():
    assert json.loads(inline_data({"a": "</script><!--&"})) == {"a": "</script><!--&"}
    assert re.search("[<>&]", inline_data("</script><!--&")) is None
    text = inline_script('x = "</script><SCRIPT><!--" ; a < b').text
    assert re.search("<(/script|script|!--)", text, re.IGNORECASE) is None
    assert text.endswith("a < b")


def test_thinning_keeps_the_extremes_and_the_ends():
    values = np.sin(np.linspace(0.0, 200.0, 50_000))
    values[[123, 40_321]] = -7.0, 9.0
    chosen = thinned(values, 1000)
    assert chosen.size <= 1000
    assert {0, 123, 40_321, 49_999} <= set(chosen.tolist())
    assert (np.diff(chosen) > 0).all()
    assert thinned(values[:10]).tolist() == list(range(10))


def second_order(passage):
    """A run whose force is off by the square of the step, of the passage's tolerance else."""
    shape = np.sin(40.0 * passage["distance"])

    def run(scenario, _):
        off = (scenario.master.step or 1e-4 * scenario.master.tolerance) ** 2
        return passage.assign(contact_force=passage["contact_force"] + 1e12 * off * shape)

    return run


def test_the_observed_order_is_that_of_the_runs(passage):
    found = study(passage, second_order(passage))
    assert [case.step for case in found.cases] == [None, None, 2e-4, 1e-4, 5e-5, 2.5e-5]
    assert found.orders == pytest.approx([2.0, 2.0], abs=1e-6)
    assert found.cases[-1].deviation == 0.0
    reader = read(write_page(passage, found))
    assert "fixed steps of 25 µs" in reader.text
    assert "2.00 , 2.00" in reader.text
    assert "--convergence" not in reader.text


def test_a_fixed_step_is_halved_three_times(passage):
    scenario = passage.attrs["scenario"].replace("max_step = 0.0002", "step = 0.0001")
    fixed = passage.assign_attrs(scenario=scenario)
    found = study(fixed, second_order(passage))
    assert [case.step for case in found.cases] == [1e-4, 5e-5, 2.5e-5, 1.25e-5]
