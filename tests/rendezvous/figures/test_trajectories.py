"""There is a panel for each case."""

from pontryagin.rendezvous import figures
from pontryagin.rendezvous.case_solutions import solved


def test_there_is_a_panel_for_each_case():
    found = {"one": solved("mixed-bounded"), "two": solved("circle-energy")}
    assert [ax.get_title() for ax in figures.trajectories(found).axes] == ["one", "two"]
