// SPDX-License-Identifier: GPL-2.0-or-later
// libFuzzer damages meshes: a conversion keeps its promises, or is refused with an error of ours.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>

#include "fuzz/damaged_patch.hpp"
#include "qmorph/convert.hpp"
#include "qmorph/error.hpp"
#include "support/invariants.hpp"

namespace {

using namespace qmorph;

/// What is wrong with a result.
std::optional<std::string> complaint(const Patch& patch, const QuadMesh& mesh) {
  if (const auto why = test::why_unsound(patch)) return "not refused: " + *why;
  if (test::is_promised_nothing(patch)) return std::nullopt;
  const auto broken = test::broken_invariants(test::without_loose_wishes(patch), mesh);
  if (!broken.empty()) return broken.front();
  const bool is_flat = std::all_of(mesh.points.begin(), mesh.points.end(), [&](const auto& p) { return p.z() == 0; });
  return is_flat ? test::find_overlap(mesh, patch.quads.size()) : std::nullopt;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Patch patch = test::damaged_patch({data, size});
  Options options;
  options.threads = 1;
  options.retry_triangles = 0;  // more of the same, which takes most of the time
  try {
    const auto found = complaint(patch, convert(patch, options).mesh);
    if (!found) return 0;
    std::fprintf(stderr, "%s\n", found->c_str());
    std::abort();
  } catch (const Error&) {
    return 0;
  }
}
