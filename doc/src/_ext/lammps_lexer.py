"""Colors for LAMMPS input scripts in ``.. code-block:: LAMMPS``."""

from pygments.lexer import RegexLexer, bygroups
from pygments.token import Comment, Keyword, Name, Number, Operator, String, Text


class LAMMPSLexer(RegexLexer):
    name = 'LAMMPS'
    aliases = ['LAMMPS']
    tokens = {
        'root': [
            (r'#.*$', Comment),
            (r'^([ \t]*)([a-z][\w/]*)', bygroups(Text, Keyword)),
            (r'&\s*\n', Operator, 'continued'),
            (r'.', Text, 'line'),
            (r'\n', Text),
        ],
        'line': [
            (r'\n', Text, '#pop'),
            (r'&[ \t]*\n', Operator),
            (r'#.*$', Comment),
            (r'\$(\{\w+\}|\w|\([^)]*\))', Name.Variable),
            (r'\b[cfv]_\w+(\[[^\]\s]*\])*', Name.Variable),
            (r'"[^"\n]*"|\'[^\'\n]*\'', String),
            (r'(?<![\w/.])[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?(?![\w/.])', Number),
            (r'[\w/]+', Text),
            (r'.', Text),
        ],
        'continued': [(r'', Text, ('#pop', 'line'))],
    }


def setup(app):
    app.add_lexer('LAMMPS', LAMMPSLexer)
    return {'parallel_read_safe': True}
