"""References to pages of the LAMMPS manual: ``:doc:`minimize <minimize>```.

The pages of this manual are written as pages of LAMMPS' own, so that they can be copied there. In
this build a page that is not here but is listed below becomes a link to LAMMPS' manual; one that
is in neither is an error, as ever.
"""

from docutils import nodes

MANUAL = 'https://docs.lammps.org/{}.html'

PAGES = set('''
    Build_package Howto_output Howto_triclinic Modify_style Packages_details
    angle_style atom_modify atom_style balance boundary comm_modify compute compute_pair
    compute_pe_atom compute_pressure compute_property_local compute_stress_atom create_atoms
    create_box delete_atoms dimension displace_atoms dump dump_image dump_modify fix fix_addforce
    fix_balance fix_box_relax fix_brownian fix_deform fix_langevin fix_modify fix_nh fix_nve
    fix_lineforce fix_numdiff fix_planeforce fix_setforce fix_spring fix_srd group min_modify min_style minimize neighbor newton
    pair_coeff pair_hybrid pair_lj pair_modify pair_style pair_write partition plugin processors
    read_data read_dump read_restart region replicate rerun reset_atoms reset_timestep restart run run_style set special_bonds
    thermo thermo_modify thermo_style timestep units variable velocity write_data write_dump
    write_restart
'''.split())


def link_to_lammps(app, env, node, contnode):
    if node.get('reftype') != 'doc':
        return None
    page = node['reftarget'].lstrip('/')
    if page not in PAGES:
        return None
    link = nodes.reference('', '', internal=False, refuri=MANUAL.format(page),
                           reftitle='LAMMPS manual')
    text = node.astext() if node.get('refexplicit') else page.replace('_', ' ')
    link += nodes.inline('', text, classes=['doc'])
    return link


def setup(app):
    app.connect('missing-reference', link_to_lammps)
    return {'parallel_read_safe': True}
