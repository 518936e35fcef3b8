#!/bin/sh
# a version for which the translation is not proved
# expect: not-comparable(lammps 1 Jan 2031 is installed, the translation is proved for 29 Sep 2021 - Update 2)
if [ "$1" = -h ]; then echo "Large-scale Atomic/Molecular Massively Parallel Simulator - 1 Jan 2031"; exit 0; fi
exit 0
