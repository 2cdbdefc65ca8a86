"""The directive ``encoder-frame``: a frame of an absolute encoder, to point at and to change.

Put this file beside ``conf.py``, name it in ``extensions``, and put ``encoder-frame.js`` and
``encoder-frame_bg.wasm`` into ``html_static_path``. Then::

    .. encoder-frame:: biss-c
       :angle-bits: 17
       :frame: 82 00 05 80 00 60 68

       What other builders than HTML show, and browsers without JavaScript.

Options are the attributes of the element; ``readonly`` is a flag.
"""

from collections import defaultdict
from html import escape

from docutils import nodes
from docutils.parsers.rst import directives
from sphinx.util.docutils import SphinxDirective


class EncoderFrame(SphinxDirective):
    required_arguments = 1
    has_content = True
    # Which options there are is known to the element alone.
    option_spec = defaultdict(lambda: directives.unchanged_required, readonly=directives.flag)

    def run(self):
        attributes = {"format": self.arguments[0], **self.options}
        written = "".join(
            f" {name}" if value is None else f' {name}="{escape(value)}"'
            for name, value in attributes.items()
        )
        return [
            nodes.raw("", f"<encoder-frame{written}>", format="html"),
            *self.parse_content_to_nodes(),
            nodes.raw("", "</encoder-frame>", format="html"),
        ]


def setup(app):
    app.add_directive("encoder-frame", EncoderFrame)
    app.add_js_file("encoder-frame.js", type="module")
    return {"parallel_read_safe": True, "parallel_write_safe": True}
