import numpy as np
import pytest

from railcosim.contact_loss import contact_losses


def test_no_loss_where_the_gap_never_opens():
    assert contact_losses(np.array([0.0, 1.0]), np.array([-1.0, 0.0])) == []


def test_switches_lie_where_the_straight_line_between_two_points_crosses_zero():
    x = np.array([0.0, 1.0, 2.0, 3.0])
    gap = np.array([-1.0, 3.0, 1.0, -1.0])
    assert contact_losses(x, gap) == [(0.25, 2.5)]


@pytest.mark.parametrize("side", [1e-13, -1e-13])
def test_the_side_on_which_the_master_landed_does_not_matter(side):
    """The gap at a located switch is zero to rounding; the interval moves by 1e-13 / 1e-4 of it."""
    x = np.array([0.0, 1.0, 2.0, 3.0, 4.0])
    gap = np.array([-1e-4, side, 1e-4, side, -1e-4])
    assert contact_losses(x, gap) == [pytest.approx((1.0, 3.0), abs=2e-9)]


def test_a_loss_that_is_open_at_an_end_reaches_to_it():
    x = np.array([0.0, 1.0, 2.0, 3.0])
    assert contact_losses(x, np.array([1.0, -1.0, -1.0, 1.0])) == [(0.0, 0.5), (2.5, 3.0)]
    assert contact_losses(x, np.ones(4)) == [(0.0, 3.0)]


def test_nothing_is_found_in_nothing():
    assert contact_losses(np.empty(0), np.empty(0)) == []
