#include "cleanup/clean_up.hpp"

#include "cleanup/change_valences.hpp"
#include "cleanup/replace_cavities.hpp"
#include "cleanup/straighten_bands.hpp"

namespace qmorph::cleanup {

// Cavities first: they keep the size of the elements better. Local changes mend what no cavity holds, at boundaries above
// all, and leave fewer irregular nodes to cancel.

std::size_t clean_up(kernel::Mesh& mesh, const SmoothingOptions& smoothing) {
  std::size_t changes = replace_cavities(mesh, smoothing);
  changes += change_valences(mesh, smoothing);
  changes += replace_cavities(mesh, smoothing);
  return changes + straighten_bands(mesh, smoothing);
}

std::size_t clean_up_near(kernel::Mesh& mesh, const SmoothingOptions& smoothing, const std::vector<Index>& nodes) {
  std::size_t changes = replace_cavities_near(mesh, smoothing, nodes);
  changes += change_valences_near(mesh, smoothing, nodes);
  return changes + replace_cavities_near(mesh, smoothing, nodes);
}

}  // namespace qmorph::cleanup
