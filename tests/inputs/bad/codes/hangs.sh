#!/bin/sh
# a program that never ends
# expect: did not finish within 2
if [ "$1" = -h ]; then echo "Large-scale Atomic/Molecular Massively Parallel Simulator - 29 Sep 2021 - Update 2"; exit 0; fi
sleep 600
