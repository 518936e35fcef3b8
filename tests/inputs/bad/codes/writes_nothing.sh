#!/bin/sh
# a program that ends well and writes nothing
# expect: wrote no such file
if [ "$1" = -h ]; then echo "Large-scale Atomic/Molecular Massively Parallel Simulator - 29 Sep 2021 - Update 2"; exit 0; fi
exit 0
