"""Reports of long computations reach the listener of the block that they are made in, and no other."""

from pontryagin.progress import listening, report


def test_only_the_innermost_listener_hears():
    outer, inner = [], []
    report("before", 1, 2)
    with listening(lambda *what: outer.append(what)):
        report("one", 1, 2)
        with listening(lambda *what: inner.append(what)):
            report("two")
        report("three", 3)
    report("after")
    assert outer == [("one", 1, 2), ("three", 3, None)]
    assert inner == [("two", None, None)]
