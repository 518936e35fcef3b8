#!/bin/sh
# a program that is killed
# expect: was killed by signal 11
if [ "$1" = -h ]; then echo "Large-scale Atomic/Molecular Massively Parallel Simulator - 29 Sep 2021 - Update 2"; exit 0; fi
kill -SEGV $$
