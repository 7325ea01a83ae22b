import zipfile

import pytest

from fmu_src.building import ensure_native_fmus
from fmu_src.native.compiler import TARGETS, compile_library, this_target
from fmu_src.native.model_resources import masses_resource, track_resource, vehicle_resource
from fmu_src.native.model_sources import MODELS
from fmu_src.structure import Structure
from track_fmu.parameters import TrackParameters

from .contact_twins import ContactPair, MassesPair
from .fmi_calls import Calls
from .library import NativeModel, load
from .twins import TrackPair, VehiclePair


@pytest.fixture(scope="session")
def libraries(tmp_path_factory):
    """All libraries, compiled for this machine."""
    folder = tmp_path_factory.mktemp("native")
    loaded = {}
    for model in MODELS:
        path = folder / f"{model}{TARGETS[this_target()].suffix}"
        path.write_bytes(compile_library(model, this_target(), name=model))
        loaded[model] = load(path)
    return loaded


@pytest.fixture(scope="session")
def short_track():
    """Twelve bays with four elements each: the same physics at a tenth of the cost."""
    return TrackParameters(bays=12, elements_per_bay=4)


@pytest.fixture(scope="session")
def resources(short_track):
    size = {"wheels": 2, "gauges": 2, "mode_pairs": 36}
    return {
        "track": track_resource(short_track, **size),
        "vehicle": vehicle_resource(wheels=2),
        "track_contact": track_resource(short_track, **size, contact=True),
        "masses": masses_resource(wheels=2),
    }


@pytest.fixture
def native(libraries, resources):
    """Makes instances with parameters set, and frees them at the end."""
    opened = []

    def make(model, resource=None, **values):
        opened.append(NativeModel(libraries[model], resource or resources[model]))
        opened[-1].set(**values)
        return opened[-1]

    yield make
    for instance in opened:
        instance.close()


@pytest.fixture
def track_pair(native):
    def make(parameters, resource=None, **options):
        return TrackPair(native, parameters, resource, **options)

    return make


@pytest.fixture
def vehicle_pair(native):
    def make(resource=None, **options):
        return VehiclePair(native, resource, **options)

    return make


@pytest.fixture
def contact_pair(native):
    def make(parameters, resource=None, **options):
        return ContactPair(native, parameters, resource, **options)

    return make


@pytest.fixture
def masses_pair(native):
    def make(resource=None, **options):
        return MassesPair(native, resource, **options)

    return make


@pytest.fixture(scope="session")
def small():
    """The structure of the short track."""
    return Structure(bays=12, elements_per_bay=4, gauges=2)


@pytest.fixture(scope="session")
def native_fmus(tmp_path_factory, small):
    """FMUs for this machine by version of FMI."""
    folder = tmp_path_factory.mktemp("fmus")
    return {version: ensure_native_fmus(folder, small, fmi_version=version) for version in (2, 3)}


@pytest.fixture(scope="session")
def contact_fmus(tmp_path_factory, small):
    """The same with the contacts on the track's side."""
    folder = tmp_path_factory.mktemp("contact_fmus")
    return {
        version: ensure_native_fmus(folder, small, contact="track", fmi_version=version)
        for version in (2, 3)
    }


@pytest.fixture(scope="session")
def unpacked(native_fmus, contact_fmus, tmp_path_factory):
    """Folders of the unpacked FMUs by version and model."""
    folders = {}
    for fmus, models in (
        (native_fmus, ("track", "vehicle")),
        (contact_fmus, ("track_contact", "masses")),
    ):
        for version, pair in fmus.items():
            for model, path in zip(models, (pair.track, pair.vehicle), strict=True):
                folders[version, model] = tmp_path_factory.mktemp(f"{model}{version}")
                with zipfile.ZipFile(path) as archive:
                    archive.extractall(folders[version, model])
    return folders


@pytest.fixture
def fmi(unpacked):
    """Makes instances of the unpacked FMUs, and frees them at the end."""
    opened = []

    def make(version, model, **options):
        opened.append(Calls(unpacked[version, model], **options))
        return opened[-1]

    yield make
    for instance in opened:
        instance.free()
