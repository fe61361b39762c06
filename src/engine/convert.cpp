// SPDX-License-Identifier: GPL-2.0-or-later
#include "qmorph/convert.hpp"

#include <exception>
#include <optional>
#include <utility>
#include <vector>

#include "chart/convert_curved.hpp"
#include "engine/convert_triangles.hpp"
#include "engine/convert_with_layers.hpp"
#include "engine/surface.hpp"
#include "space/faults.hpp"

namespace qmorph {
namespace {

/// Where triangles of a curved surface are turned over among their neighbours, quads that are good by these very
/// triangles are so, too. Then, and where no valid quads are found, the nodes of such triangles are put right first.
SurfaceWork convert_curved_patch(const Patch& patch, const Options& options, Budget& budget) {
  const auto work = [&](const Patch& one) { return convert_with_layers(one, {}, options, budget); };
  const std::size_t kept = patch.quads.size();
  std::optional<SurfaceWork> as_it_is;
  std::vector<space::Suspect> suspects;
  std::exception_ptr failure;
  try {
    as_it_is = work(patch);
    suspects = space::find_suspects(patch, as_it_is->conversion.mesh, kept);
    if (suspects.empty()) return std::move(*as_it_is);
  } catch (const SurfaceError& error) {
    if (error.kind() != ErrorKind::no_valid_mesh) throw;
    failure = std::current_exception();
  }
  if (auto put_right = chart::work_put_right(patch, kept, options, work)) return std::move(*put_right);
  if (failure) std::rethrow_exception(failure);
  chart::require_none_turned(patch, as_it_is->conversion.mesh, kept, std::move(suspects));
  return std::move(*as_it_is);
}

}  // namespace

SurfaceWork convert_patch(const Patch& patch, const Options& options, Budget& budget) {
  if (patch.triangles.empty()) return convert_triangles(patch, {}, options, budget, nullptr);
  const std::optional<Plane> plane = find_plane(patch);
  return plane ? convert_with_layers(patch, plane, options, budget) : convert_curved_patch(patch, options, budget);
}

Conversion convert(const Patch& patch, const Options& options) { return work_on_patch(patch, options, convert_patch); }

std::vector<Outcome> convert_all(const std::vector<const Patch*>& patches, const Options& options) {
  return work_on_patches(patches, options, convert_patch);
}

}  // namespace qmorph
