// SPDX-License-Identifier: GPL-2.0-or-later
#include "cleanup/clean_up.hpp"

#include <optional>

#include "cleanup/change_valences.hpp"
#include "cleanup/replace_cavities.hpp"
#include "cleanup/straighten_bands.hpp"

namespace qmorph::cleanup {

// Cavities first: they keep the size of the elements better. Local changes mend what no cavity holds, at boundaries
// above all, and leave fewer irregular nodes to cancel.

std::size_t clean_up(kernel::Mesh& mesh, const SmoothingOptions& smoothing, const kernel::Budget& budget,
                     const CavityLimits& limits) {
  // In a small mesh another try costs little, and what is found by chance counts.
  constexpr std::size_t kLarge = 20'000;  // faces
  std::optional<Refused> large;
  Refused* const refused = mesh.face_slots() >= kLarge ? &large.emplace(mesh) : nullptr;
  std::size_t changes = replace_cavities(mesh, smoothing, budget, limits, refused);
  changes += change_valences(mesh, smoothing, budget, refused);
  if (changes > 0) changes += replace_cavities(mesh, smoothing, budget, limits, refused);
  return changes + straighten_bands(mesh, smoothing, budget);
}

std::size_t clean_up_near(kernel::Mesh& mesh, const SmoothingOptions& smoothing, const std::vector<Index>& nodes,
                          const kernel::Budget& budget) {
  std::size_t changes = replace_cavities_near(mesh, smoothing, nodes, budget);
  changes += change_valences_near(mesh, smoothing, nodes, budget);
  return changes + replace_cavities_near(mesh, smoothing, nodes, budget);
}

}  // namespace qmorph::cleanup
