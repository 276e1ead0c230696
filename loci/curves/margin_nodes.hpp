// Nodes of margin curves as stars of the sheets that the curves are traced on.
#pragma once

#include <vector>

#include "core/locus_factor.hpp"
#include "loci/search/search.hpp"
#include "loci/sheet/sheet.hpp"

namespace clearloci::loci {

/// Of factors of one problem in one mode, all that they have. May be long to find: once a problem and mode.
class MarginNodes {
 public:
  MarginNodes(const core::LocusProblem& problem, const core::WorkingMode& mode, const sheet::ZeroOptions& options);

  /// The nodes of a factor of the problem; of others none.
  std::vector<sheet::Star> of(const core::LocusFactor& factor) const;
  /// Those that both factors have.
  std::vector<sheet::Star> of(const core::LocusFactor& first, const core::LocusFactor& second) const;

 private:
  struct Group {
    std::vector<const core::LocusFactor*> factors;  ///< whose forms have one last part
    std::vector<sheet::Star> stars;
  };
  const Group* group_of(const core::LocusFactor& factor) const;

  const core::LocusProblem& problem_;
  std::vector<Group> groups_;
};

}  // namespace clearloci::loci
