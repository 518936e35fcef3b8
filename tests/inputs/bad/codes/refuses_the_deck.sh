#!/bin/sh
# a program that ends with an error of its own
# expect: ended with exit code 1, saying: ERROR: Unknown command
if [ "$1" = -h ]; then echo "Large-scale Atomic/Molecular Massively Parallel Simulator - 29 Sep 2021 - Update 2"; exit 0; fi
echo "ERROR: Unknown command (src/input.cpp:1)"; exit 1
