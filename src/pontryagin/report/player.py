"""Pages that replay a recording in a browser, from the file system and with no network.

rerun's wheel carries its web viewer. It is taken from there once per version, over the loopback interface,
and wrapped into one classic script that all pages share; each page holds its recording.
"""

import gzip
import html
import os
import socket
import subprocess
import time
import urllib.request
from base64 import b64encode
from importlib import metadata, util
from pathlib import Path

from pontryagin.io import files, sealed
from pontryagin.report.recordings import Clip
from pontryagin.report.render_html import ASSETS
from pontryagin.report.workspace import Workspace

START_TIMEOUT = 60.0

_START = """
window.pontryaginViewer = async canvas => {
  const packed = Uint8Array.from(atob(pontryaginViewerWasm), c => c.charCodeAt(0));
  pontryaginViewerWasm = null;
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  await wasm_bindgen({module_or_path: await new Response(stream).arrayBuffer()});
  const handle = new wasm_bindgen.WebHandle({
    url: [], hide_welcome_screen: true, enable_history: false, persist: false, notebook: true, theme: "light",
    panel_state_overrides: {top: "Hidden", blueprint: "Hidden", selection: "Hidden", time: "Collapsed"},
  });
  await handle.start(canvas);
  return handle;
};
"""


class NoViewer(RuntimeError):
    """The web viewer could not be had; the message says why."""


def write_players(workspace: Workspace, clips: list[Clip]) -> list[Path]:
    """Write a page per recording and the script that they share.

    Raises
    ------
    NoViewer
        When rerun is absent or does not serve its viewer.
    """
    folder = workspace.report / "play"
    files.write(folder / "viewer.js", viewer_script(workspace))
    pages = []
    for clip in clips:
        recording = (workspace.recordings / f"{clip.name}.rrd").read_bytes()
        pages.append(folder / f"{clip.name}.html")
        files.write(pages[-1], player_page(clip, recording))
    for stale in set(folder.glob("*.html")) - set(pages):
        stale.unlink()
    return pages


def player_page(clip: Clip, recording: bytes) -> str:
    """The page of one recording; it may load nothing but the script beside it."""
    parts = {
        "@TITLE@": html.escape(clip.title),
        "@DESCRIPTION@": html.escape(clip.description),
        "@FILE@": html.escape(f"{clip.name}.rrd"),
        "@RECORDING@": b64encode(recording).decode(),
    }
    page = (ASSETS / "player.html").read_text(encoding="utf-8")
    for mark, content in parts.items():
        page = page.replace(mark, content)
    return page


def viewer_script(workspace: Workspace) -> bytes:
    """The viewer as one script, from the cache when this version of rerun was asked before."""
    try:
        version = metadata.version("rerun-sdk")
    except metadata.PackageNotFoundError:
        raise NoViewer("rerun-sdk is not installed here") from None
    place = workspace.cache / "viewer" / f"{version}.js"
    kept = sealed.read(place)
    if kept is None:
        script, wasm = _served("re_viewer.js", "re_viewer_bg.wasm")
        packed = b64encode(gzip.compress(wasm, mtime=0))
        body = b'\nlet pontryaginViewerWasm = "' + packed + b'";\n'
        kept = script + body + _START.encode()
        sealed.write(place, kept)
    return kept


def _served(*names: str) -> list[bytes]:
    spec = util.find_spec("rerun_cli")
    folder = Path(next(iter(spec.submodule_search_locations or []))) if spec else Path()
    program = next((p for p in (folder / "rerun", folder / "rerun.exe") if p.is_file()), None)
    if program is None:
        raise NoViewer("rerun-sdk came without its command line here")
    web, grpc = _free_ports(2)
    command = [str(program), "--serve-web", "--bind", "127.0.0.1", "--port", str(grpc)]
    command += ["--web-viewer-port", str(web)]
    quiet = {**os.environ, "RERUN_ANALYTICS": "0", "BROWSER": "true", "DISPLAY": "", "WAYLAND_DISPLAY": ""}
    server = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=quiet)
    try:
        return [_fetch(f"http://127.0.0.1:{web}/{name}", server) for name in names]
    finally:
        server.terminate()
        server.wait(10)


def _fetch(address: str, server: subprocess.Popen[bytes]) -> bytes:
    direct = urllib.request.build_opener(urllib.request.ProxyHandler({}))
    deadline = time.monotonic() + START_TIMEOUT
    while True:
        try:
            with direct.open(address, timeout=START_TIMEOUT) as answer:
                return answer.read()
        except OSError as error:
            if server.poll() is not None or time.monotonic() > deadline:
                raise NoViewer(f"rerun did not serve its viewer: {error}") from None
            time.sleep(0.2)


def _free_ports(count: int) -> list[int]:
    held = [socket.socket() for _ in range(count)]
    for one in held:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in held]
    for one in held:
        one.close()
    return ports
