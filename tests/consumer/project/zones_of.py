"""Prints how many zones a mechanism has."""

import sys

import clearloci

print(len(clearloci.read(sys.argv[1]).zones()), "zones")
