"""The finished pages in a real browser, opened from the file system with no network."""

import asyncio
import json
import subprocess
import urllib.request
from base64 import b64decode
from contextlib import contextmanager
from io import BytesIO

import numpy as np
import pytest
from PIL import Image
from tornado.websocket import websocket_connect

from pontryagin.display import recording
from pontryagin.report import browser, player, text
from pontryagin.report.recordings import Clip
from pontryagin.report.render_html import render_html

PATIENCE = 150
DRAWS_3D = ("--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")
NO_NETWORK = "--host-resolver-rules=MAP * ~NOTFOUND"


@contextmanager
def chromium(program, profile):
    options = [option for option in browser.OPTIONS if option != "--disable-gpu"]
    command = [
        program,
        *options,
        *DRAWS_3D,
        NO_NETWORK,
        f"--user-data-dir={profile}",
        "--window-size=1200,800",
    ]
    process = subprocess.Popen(
        [*command, "--remote-debugging-port=0", "about:blank"], stderr=subprocess.PIPE, text=True
    )
    try:
        told = next(line for line in process.stderr if "DevTools listening" in line)
        yield told.split("127.0.0.1:")[1].split("/")[0]
    finally:
        process.terminate()
        process.wait()


async def watch(port, page):
    """What became of a player page, and two pictures of it taken some time apart."""
    tabs = json.load(urllib.request.urlopen(f"http://127.0.0.1:{port}/json"))
    (tab,) = [tab for tab in tabs if tab["type"] == "page"]
    socket = await websocket_connect(tab["webSocketDebuggerUrl"], max_message_size=2**28)
    calls = iter(range(1, 10_000))

    async def call(method, **parameters):
        number = next(calls)
        await socket.write_message(json.dumps({"id": number, "method": method, "params": parameters}))
        while (answer := json.loads(await socket.read_message())).get("id") != number:
            pass
        return answer["result"]

    async def picture():
        shot = await call("Page.captureScreenshot")
        return np.asarray(Image.open(BytesIO(b64decode(shot["data"]))).convert("L"), dtype=float)

    await call("Page.navigate", url=page.as_uri())
    for _ in range(PATIENCE):
        state = await call("Runtime.evaluate", expression="document.documentElement.dataset.state || ''")
        if state["result"].get("value"):
            break
        await asyncio.sleep(1)
    for _ in range(PATIENCE):
        first = await picture()
        await asyncio.sleep(1)
        second = await picture()
        if np.abs(first[100:, :600] - second[100:, :600]).max() > 50:
            break
    return state["result"].get("value"), first, second


def turning_box(path):
    t = np.linspace(0, 4, 81)
    attitude = np.stack([np.cos(t), 0 * t, np.sin(t), 0 * t], axis=-1)
    layout = [[recording.Scene("the turn", "turn")], [recording.Plot("angle", "angle")]]
    with recording.record(path, "turn", layout) as turn:
        turn.body("turn/craft", t, attitude, size=(2.0, 1.2, 0.6), colour="#0072B2")
        turn.curve("angle/a", t, 2 * t, "angle", "red")


@pytest.mark.slow
def test_a_browser_reads_every_formula_and_plays_the_recording(checkout, tmp_path):
    program = browser.find()
    if program is None:
        pytest.skip("no Chromium on this machine")
    title = {"pagetitle": "p", "subtitle": "s", "imprint": "i"}
    read = text.read("Here $\\|u\\|_2$ and\n\n$$x \\tag{1.2}$$\n\nand $\\bm{x}$, which MathJax has not.\n")
    page = tmp_path / "index.html"
    page.write_text(render_html(read.document, checkout.root, title), encoding="utf-8")
    assert browser.typeset(page, program) == browser.Typeset(3, [r"\bm{x}"])

    turning_box(checkout.workspace.recordings / "turn.rrd")
    clip = Clip("p", "turn", "A turn", "A box turns.")
    (player_page,) = player.write_players(checkout.workspace, [clip])
    with chromium(program, tmp_path / "profile") as port:
        state, first, second = asyncio.run(watch(port, player_page))
    assert state == "playing"
    stage = first[100:, :600]
    assert np.std(stage) > 10, "the scene is empty"
    assert np.abs(stage - second[100:, :600]).max() > 50, "nothing moves"
