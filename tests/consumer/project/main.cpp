// Prints the discontinuity loci of a mechanism, one a line.
#include <analysis/loci.hpp>
#include <iostream>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const clearloci::mechanism::Mechanism mechanism = clearloci::mechanism::read_mechanism(argv[1]);
  const clearloci::core::LocusMap map = clearloci::trace_loci(mechanism);
  for (const clearloci::core::LocusCurve& curve : map.curves)
    std::cout << curve.id << ": " << to_string(curve.kind) << ", " << to_string(curve.implicit, map.tower.coordinates)
              << " = 0\n";
  std::cout << map.curves.size() << " curves\n";
  return map.complete ? 0 : 1;
}
