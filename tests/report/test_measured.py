"""The benchmarks' chapter shows what was measured, and nothing where nothing was."""

from pontryagin.report.measured import benchmarks


def test_the_chapter_holds_the_tables_that_fit_and_the_pictures_that_exist(checkout):
    assert benchmarks(checkout.workspace) == ""
    folder = checkout.workspace.figures / "benchmarks"
    (folder / "triple-integrator").mkdir(parents=True)
    (folder / "benchmarks.md").write_text(
        "# Benchmarks\n\nAll.\n\n## Turns\n\nprocessor x; seed 1.\n\n"
        "### Side by side\n\n| a |\n| --: |\n| 1 |\n\n"
        "### Least time, share of inputs failed at each scale\n\n| long |\n| --- |\n"
    )
    (folder / "triple-integrator" / "stack-size.svg").write_text("<svg/>")
    chapter = benchmarks(checkout.workspace)
    assert "processor x; seed 1." in chapter and "### Side by side" in chapter and "## Turns" in chapter
    assert "triple-integrator/stack-size.svg" in chapter
    assert "long" not in chapter and "accuracy-and-time" not in chapter
