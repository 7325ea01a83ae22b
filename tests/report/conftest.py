"""A passage in which the flat's wheel leaves the rail, its page, and a browser to open it in."""

import os
import shutil
from contextlib import contextmanager

import pytest

from railcosim.builds import usual_build
from railcosim.master_section import Master
from railcosim.passage import run_passage
from railcosim.report.page import write_page
from railcosim.scenario import Scenario
from railcosim.sections import Flat, Run

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
REQUIRED = os.environ.get("RAILCOSIM_BROWSER") == "required"


@pytest.fixture(scope="session")
def passage():
    scenario = Scenario(
        flat=Flat(depth=2e-3),
        run=Run(approach=0.6, departure=1.05),
        master=Master(tolerance=1e-2),
    )
    return run_passage(scenario, fmus=usual_build("vehicle"))


@pytest.fixture(scope="session")
def page(passage):
    return write_page(passage)


@pytest.fixture(scope="session")
def browser():
    """Return a browser without a window; skip where there is none, unless there must be one."""
    found = next((path for name in BROWSERS if (path := shutil.which(name))), None)
    if found is None:
        message = f"none of {', '.join(BROWSERS)} is installed"
        if REQUIRED:
            pytest.fail(message)
        pytest.skip(message)
    sync_api = pytest.importorskip("playwright.sync_api") if not REQUIRED else _playwright()
    with sync_api.sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=found, args=["--no-sandbox"])
        yield browser
        browser.close()


def _playwright():
    import playwright.sync_api  # noqa: PLC0415 - only where a browser must be there

    return playwright.sync_api


@pytest.fixture(scope="session")
def opened(browser, page, tmp_path_factory):
    """Return what opens a page from its file; it must neither complain nor fetch anything."""
    file = tmp_path_factory.mktemp("report") / "report.html"

    @contextmanager
    def opened(text=page, **settings):
        file.write_text(text, encoding="utf-8")
        complaints, fetched = [], []
        context = browser.new_context(**settings)
        tab = context.new_page()
        tab.on("console", lambda message: complaints.append(message.text))
        tab.on("pageerror", lambda error: complaints.append(str(error)))
        tab.on("dialog", lambda dialog: (complaints.append(dialog.message), dialog.dismiss()))

        def answer(route):
            if route.request.url == file.as_uri():
                route.continue_()
            else:
                fetched.append(route.request.url)
                route.abort()

        context.route("**/*", answer)
        tab.goto(file.as_uri())
        yield tab
        context.close()
        assert complaints == []
        assert fetched == []

    return opened
