"""What MDAnalysis sees in a structure: counts, names, bonds and box, as JSON. Run by test_molecules.py with an interpreter that
has MDAnalysis: read_molecules.py topology coordinates."""

import json
import sys
import warnings

warnings.filterwarnings("ignore")
import MDAnalysis    # noqa: E402

files = sys.argv[1:]
options = {"atom_style": "id resid type charge x y z"} if files[0].endswith(".data") else {}
u = MDAnalysis.Universe(*files, **options)
has_names = hasattr(u.atoms, "names")
print(json.dumps({
    "atoms": len(u.atoms), "residues": len(u.residues),
    "bonds": len(u.bonds) if hasattr(u, "bonds") else 0,
    "angles": len(u.angles) if hasattr(u, "angles") else 0,
    "names": list(u.atoms.names[:12]) if has_names else [],
    "resnames": sorted(set(u.atoms.resnames)) if hasattr(u.atoms, "resnames") else [],
    "box": [float(v) for v in u.dimensions],
    "places": [[float(v) for v in x] for x in u.atoms.positions[:24]],
    "lengths": [float(v) for v in u.bonds.values()[:2000]] if hasattr(u, "bonds") and len(u.bonds) else []}))
