"""A page in Sphinx with <encoder-frame>, and the directive that any other project can use."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

project = "Reading absolute encoders"
extensions = ["encoder_frame"]
html_theme = "alabaster"
html_show_copyright = False
# The two files of the element, as `make dist` leaves them.
html_static_path = ["../../dist/encoder-frame.js", "../../dist/encoder-frame_bg.wasm"]
