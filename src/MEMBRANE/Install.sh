# Install/unInstall package files in LAMMPS
# mode = 0/1/2 for uninstall/install/update

mode=$1

# enforce using portable C locale
LC_ALL=C
export LC_ALL

# atom style membrane_cp derives from atom style angle

if (test $mode = 1 && test ! -e ../atom_vec_angle.h) then
  echo "  MEMBRANE needs the MOLECULE package: make yes-molecule yes-membrane"
  exit 1
fi

# newer LAMMPS keeps the base class of the dump style in a package

if (test $mode = 1 && test -d ../GRAPHICS && test ! -e ../dump_image.h) then
  echo "  MEMBRANE needs the GRAPHICS package: make yes-graphics yes-membrane"
  exit 1
fi

# arg1 = file

action () {
  if (test $mode = 0) then
    rm -f ../$1
  elif (! cmp -s $1 ../$1) then
    cp $1 ..
    if (test $mode = 2) then
      echo "  updating src/$1"
    fi
  fi
}

for file in *.cpp *.h; do
  test -f ${file} && action $file
done

# Eigen headers: set EIGEN3_INCLUDE_DIR if they are elsewhere

if (test -e ../Makefile.package) then
  sed -i -e 's|-DEIGEN_MAX_ALIGN_BYTES=16 -I[^ ]* ||g' ../Makefile.package
  if (test $mode != 0) then
    eigen="-DEIGEN_MAX_ALIGN_BYTES=16 -I${EIGEN3_INCLUDE_DIR:-/usr/include/eigen3}"
    sed -i -e "s|^PKG_SYSINC =[ \t]*|&${eigen} |" ../Makefile.package
  fi
fi
