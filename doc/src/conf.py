# Configuration of the manual: sphinx-build -W -b html doc/src doc/html, or doc/build.
# Needs Sphinx only (Debian: python3-sphinx), no network.

import os
import sys

sys.path.insert(0, os.path.abspath('_ext'))

project = 'MEMBRANE'
author = 'the MEMBRANE developers'
copyright = 'the MEMBRANE developers, GPL-2.0'

extensions = ['lammps_links', 'lammps_lexer', 'mathml']
source_suffix = '.rst'
exclude_patterns = ['_ext']
nitpicky = True
html_math_renderer = 'mathml'
highlight_language = 'none'
pygments_style = 'friendly'

html_title = 'MEMBRANE manual'
html_theme = 'alabaster'
html_theme_options = {
    'description': 'Lipid bilayers in LAMMPS as limit surfaces of Loop subdivision',
    'fixed_sidebar': True,
    'page_width': '1120px',
    'sidebar_width': '260px',
    'body_max_width': '800px',
    'show_powered_by': False,
    'code_font_size': '0.85em',
}
html_sidebars = {'**': ['about.html', 'navigation.html', 'searchbox.html']}
html_static_path = ['_static']
html_css_files = ['manual.css']
html_show_sourcelink = False
html_copy_source = False
