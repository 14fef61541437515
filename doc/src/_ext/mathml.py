"""Formulas as MathML, which browsers draw by themselves: no JavaScript, no fonts, no network.

Docutils does the conversion. It knows the LaTeX of this manual but not all of LaTeX; what it does
not know is an error of the build.
"""

import re

from docutils import nodes
from docutils.utils.math.latex2mathml import tex2mathml
from sphinx.util import logging
from sphinx.util.math import get_node_equation_number

logger = logging.getLogger(__name__)


def brace_fractions(tex):
    r"""``\frac12`` as ``\frac{1}{2}``: docutils takes the 12 for one number."""
    tex = re.sub(r'\\frac\s*([0-9A-Za-z])', r'\\frac{\1}', tex)
    return re.sub(r'(\\frac\{[^{}]*\})\s*([0-9A-Za-z])', r'\1{\2}', tex)


def convert(node, block):
    tex = brace_fractions(node.astext())
    if tex[:1] in ('^', '_'):    # an exponent after plain text
        tex = '{}' + tex
    try:
        try:
            code = tex2mathml(tex, as_block=block)    # docutils 0.21 and later
        except TypeError:
            code = tex2mathml(tex, inline=not block)
    except Exception as err:
        logger.warning('formula %r: %s', tex, err, location=node)
        return '<code>{}</code>'.format(nodes.unescape(tex))
    return re.sub(r'<mi mathvariant="bold">(\w+)</mi>', bold, code)


def bold(match):
    """Letters that are bold themselves: browsers ignore the attribute."""
    def letter(c):
        if 'A' <= c <= 'Z':
            return chr(0x1D400 + ord(c) - ord('A'))
        if 'a' <= c <= 'z':
            return chr(0x1D41A + ord(c) - ord('a'))
        return c
    return '<mi mathvariant="normal">{}</mi>'.format(''.join(map(letter, match.group(1))))


def visit_math(self, node):
    self.body.append(self.starttag(node, 'span', '', CLASS='math notranslate nohighlight'))
    self.body.append(' '.join(convert(node, block=False).split()) + '</span>')
    raise nodes.SkipNode


def visit_displaymath(self, node):
    self.body.append(self.starttag(node, 'div', CLASS='math notranslate nohighlight'))
    if node['number']:
        self.body.append('<span class="eqno">({})'.format(get_node_equation_number(self, node)))
        self.add_permalink_ref(node, 'Permalink to this equation')
        self.body.append('</span>')
    self.body.append(convert(node, block=True) + '</div>\n')
    raise nodes.SkipNode


def setup(app):
    app.add_html_math_renderer('mathml', (visit_math, None), (visit_displaymath, None))
    return {'parallel_read_safe': True}
