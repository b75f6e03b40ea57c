"""Settings of Sphinx for the manual; make_manual.py writes its pages."""

project = "rsc"
html_title = "rsc: contact of rough surfaces"
copyright = "the rsc developers"  # the name that Sphinx gives to this setting
extensions = []
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
html_static_path = ["_static"]
html_css_files = ["manual.css"]
html_show_sphinx = False
highlight_language = "none"
smartquotes = False  # -- and quotes stand in commands


def setup(app):
    app.add_object_type("key", "key", "%s (key of a case)")
