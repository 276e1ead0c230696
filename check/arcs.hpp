// Holds the arcs of a certificate against the curve that the cells of their function prove: arcs run along it, and
// what of it no arc covers is outside, or makes nothing wanted vanish. Private to check/.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "check/certificate.hpp"
#include "check/curves.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci::check {

/// An arc of the certificate, and whether it was found to be what some sheet says.
struct KnownArc {
  const CurveClaim* curve = nullptr;
  const core::Arc* arc = nullptr;
  int sheet = -1;  ///< by which it was found right; -1: none yet
};

/// What a curve has to do with the statics of its mode.
struct CurvePart {
  int number = 0;                ///< of the sheet
  std::vector<int> singular;     ///< functions on which |A| vanishes; those other than the curve's own cut it
  std::set<Reaction> vanishing;  ///< reactions that its function is a factor of
};

/// Throws FalseClaim. What is neither shown nor refuted is added to `unchecked`.
void check_arcs(const mechanism::Mechanism& m, Curve& curve, const CurvePart& part, std::vector<KnownArc>& arcs,
                std::vector<std::string>& unchecked);

}  // namespace clearloci::check
