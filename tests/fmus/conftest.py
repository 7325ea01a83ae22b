import pytest

from fmu_src.building import ensure_fmus
from fmu_src.structure import Structure

from .instance import Instance


@pytest.fixture(scope="session")
def fmus(tmp_path_factory):
    """The FMUs of the paper's track and bogie, freshly built."""
    return ensure_fmus(tmp_path_factory.mktemp("fmus"))


@pytest.fixture(scope="session")
def small_fmus(tmp_path_factory):
    """A short track and one wheel, which start quickly."""
    structure = Structure(bays=12, elements_per_bay=4, wheels=1, gauges=1)
    return ensure_fmus(tmp_path_factory.mktemp("small"), structure)


@pytest.fixture
def open_fmu():
    """Opens instances and frees them at the end."""
    opened = []

    def open_one(path, **values):
        opened.append(Instance(path, **values))
        return opened[-1]

    yield open_one
    for instance in opened:
        instance.close()
