"""A kept result is computed once while the key of its module stays; without a key it is not kept."""

import json
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import pytest

from pontryagin.io import kept_results
from pontryagin.io.kept_results import between_processes, kept


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv(kept_results.FOLDER, str(tmp_path))
    hand_down(tmp_path, a="1", b="1")
    return tmp_path


def hand_down(folder, **keys):
    """Write keys, as a build does before it starts the processes that read them."""
    (folder / kept_results.KEYS).write_text(json.dumps(keys))
    kept_results._keys.cache_clear()


def square(log, number):
    log.append(number)
    return number**2


def test_a_result_is_computed_once_for_each_module_name_and_key(folder):
    log = []
    for _ in range(2):
        assert between_processes("a", "3", lambda: square(log, 3)) == 9
        assert between_processes("a", "4", lambda: square(log, 4)) == 16
        assert between_processes("b", "3", lambda: square(log, -3)) == 9
    assert log == [3, 4, -3]
    hand_down(folder, a="2", b="1")
    assert between_processes("a", "3", lambda: square(log, 3)) == 9
    assert between_processes("b", "3", lambda: square(log, -3)) == 9
    assert log == [3, 4, -3, 3]
    hand_down(folder, a="1", b="1")
    assert between_processes("a", "3", lambda: square(log, 3)) == 9
    assert log == [3, 4, -3, 3]


def test_without_a_key_or_a_folder_nothing_is_kept(folder, monkeypatch):
    log = []
    for _ in range(2):
        between_processes("unknown", "3", lambda: square(log, 3))
    monkeypatch.delenv(kept_results.FOLDER)
    for _ in range(2):
        between_processes("a", "3", lambda: square(log, 3))
    assert len(log) == 4
    assert [path.name for path in folder.iterdir()] == [kept_results.KEYS]


def test_a_failure_is_not_kept(folder):
    for _ in range(2):
        with pytest.raises(ZeroDivisionError):
            between_processes("a", "1/0", lambda: 1 / 0)
    assert not list(folder.rglob("*.pickle"))


def test_who_needs_a_result_that_another_computes_waits_for_it(folder):
    log, start = [], threading.Barrier(4)

    def slowly():
        log.append(1)
        time.sleep(0.1)
        return 7

    def ask(_):
        start.wait()
        return between_processes("a", "slow", slowly)

    with ThreadPoolExecutor(4) as pool:
        assert list(pool.map(ask, range(4))) == [7] * 4
    assert log == [1]


def test_old_results_are_forgotten(folder):
    for key in range(2 * kept_results.STATES):
        hand_down(folder, a=str(key))
        assert between_processes("a", "key", lambda key=key: key) == key
    assert len(list(folder.rglob("*.pickle"))) == kept_results.STATES


def test_arguments_tell_results_apart_and_a_process_gets_the_same_object(folder):
    hand_down(folder, **{__name__: "1"})
    log = []

    @kept
    def pair(first, second="x"):
        log.append((first, second))
        return [first, second]

    assert pair(1) == [1, "x"] and pair(1, second="y") == [1, "y"] and pair("1") == ["1", "x"]
    assert pair(1) is pair(1)
    assert len(log) == 3 and pair.__name__ == "pair"
    assert len(list(folder.rglob("*.pickle"))) == 3


def test_ahead_a_result_is_computed_unless_it_is_there_or_on_its_way(folder):
    hand_down(folder, **{__name__: "1"})
    log, started, go_on = [], threading.Event(), threading.Event()

    @kept
    def slowly(number):
        log.append(number)
        started.set()
        assert go_on.wait(10)
        return number

    with ThreadPoolExecutor(1) as pool:
        running = pool.submit(slowly, 1)
        assert started.wait(10)
        slowly.ahead(1)
        assert log == [1]
        go_on.set()
        assert running.result() == 1
    slowly.ahead(2)
    slowly.ahead(2)
    assert log == [1, 2] and slowly(2) == 2 and log == [1, 2]


@pytest.mark.parametrize(
    "damage", [lambda data: b"", lambda data: data[:-9], lambda data: data[:9] + b"?" + data[10:]]
)
def test_a_damaged_result_is_computed_anew(folder, damage):
    log = []
    assert between_processes("a", "3", lambda: square(log, 3)) == 9
    (place,) = folder.glob("a/*/*.pickle")
    place.write_bytes(damage(place.read_bytes()))
    for _ in range(2):
        assert between_processes("a", "3", lambda: square(log, 3)) == 9
    assert log == [3, 3]


def test_damaged_keys_are_no_keys(folder):
    (folder / kept_results.KEYS).write_text('{"a": "1"')
    kept_results._keys.cache_clear()
    assert between_processes("a", "3", lambda: 9) == 9
