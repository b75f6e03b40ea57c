"""Settings of Sphinx for the manual; make_manual.py writes its pages."""

import inspect

from docutils import nodes
from docutils.utils.math.latex2mathml import tex2mathml

project = "rsc"
html_title = "rsc: contact of rough surfaces"
copyright = "the rsc developers"  # the name that Sphinx gives to this setting
extensions = ["sphinx.ext.autosectionlabel"]
autosectionlabel_prefix_document = True
exclude_patterns = []
html_theme = "alabaster"
html_theme_options = {
    "description": "contact of rough surfaces",
    "page_width": "1100px",
    "sidebar_width": "230px",
    "fixed_sidebar": True,
}
html_sidebars = {"**": ["about.html", "searchbox.html", "navigation.html"]}
html_copy_source = False
toc_object_entries = False  # the navigation has no methods
html_static_path = ["_static"]
html_css_files = ["manual.css"]
html_show_sphinx = False
highlight_language = "none"
smartquotes = False  # -- and quotes stand in commands
html_math_renderer = "mathml"  # set by browsers themselves, without a network

# Newer versions of docutils have the opposite of this argument.
AS_BLOCK = "as_block" in inspect.signature(tex2mathml).parameters


def formula(translator, node):
    block = isinstance(node, nodes.math_block)
    text = tex2mathml(node.astext(), block == AS_BLOCK)
    for bracket in "⟨⟩":  # as high as parentheses
        text = text.replace(f"<mo>{bracket}", f'<mo stretchy="false">{bracket}')
    text = text.replace("<mo>&ApplyFunction;</mo>", '<mspace width="0.17em"></mspace>')
    translator.body.append(text)
    raise nodes.SkipNode


def setup(app):
    app.add_html_math_renderer("mathml", (formula, None), (formula, None))
    app.add_object_type("key", "key", "%s (key of a case)")
