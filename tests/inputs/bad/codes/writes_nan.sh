#!/bin/sh
# a program that writes what is not a number
# expect: history.dump:10: not 16 finite numbers
if [ "$1" = -h ]; then echo "Large-scale Atomic/Molecular Massively Parallel Simulator - 29 Sep 2021 - Update 2"; exit 0; fi
dump() {
  awk -v nan="$1" -v last="$2" "BEGIN {
    for (step = 0; step <= last; step++) {
      print \"ITEM: TIMESTEP\"; print step; print \"ITEM: NUMBER OF ATOMS\"; print 1
      print \"ITEM: BOX BOUNDS ff ff ff\"; print \"-0.1 0.1\"; print \"-0.1 0.1\"; print \"-2 2\"
      print \"ITEM: ATOMS id xu yu zu vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz\"
      print 1, 0, 0, (step == nan ? \"nan\" : 1), 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0
    }
  }" > history.dump
  awk "/^set atom 1 diameter/ { mass = \$7; radius = \$5 / 2 } END {
    for (step = 0; step <= 6000; step += 6000) {
      print \"ITEM: TIMESTEP\"; print step; print \"ITEM: NUMBER OF ATOMS\"; print 1
      print \"ITEM: BOX BOUNDS ff ff ff\"; print \"-0.1 0.1\"; print \"-0.1 0.1\"; print \"-2 2\"
      print \"ITEM: ATOMS id type mass radius\"; print 1, 1, mass, radius
    }
  }" scene.lmp > particles.dump
}
dump 0 6000
