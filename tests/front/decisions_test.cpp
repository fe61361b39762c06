// SPDX-License-Identifier: GPL-2.0-or-later
// Which other constants would make the same of a mesh.
#include "front/decisions.hpp"

#include <doctest/doctest.h>

#include <bit>

#include "front/fixture.hpp"
#include "front/morph.hpp"
#include "topology/edits.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;

FrontOptions random_options(Rng& rng) {
  FrontOptions options;
  for (double* constant : {&options.corner_angle, &options.seam_angle, &options.seam_angle_many,
                           &options.transition_ratio, &options.side_edge_angle})
    if (rng.chance(0.5)) *constant *= rng.between(0.5, 1.5);
  return options;
}

std::uint64_t fingerprint(const Mesh& mesh) {
  std::uint64_t sum = topology::connectivity(mesh);
  for (Index v = 0; v < mesh.vertex_slots(); ++v)
    for (double x : {mesh.point(v).x(), mesh.point(v).y()}) sum = 31 * sum + std::bit_cast<std::uint64_t>(x);
  return sum;
}

struct Made {
  front::Decisions decisions;
  std::uint64_t fingerprint;
};

Made advance(Mesh mesh, const FrontOptions& options) {
  Made made{};
  front::morph(mesh, options, {.decisions = &made.decisions});
  made.fingerprint = fingerprint(mesh);
  return made;
}

}  // namespace

TEST_CASE("decisions: constants that would decide alike make the same mesh, and others often a different one") {
  int same = 0, others = 0, other_meshes = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    CAPTURE(seed);
    Rng rng(seed);
    const Mesh mesh = random_mesh(rng);
    if (mesh.face_slots() > 60) continue;
    const Made one = advance(mesh, random_options(rng));
    for (int i = 0; i < 10; ++i) {
      const FrontOptions options = random_options(rng);
      const Made other = advance(mesh, options);
      const bool is_same = one.fingerprint == other.fingerprint;
      if (one.decisions.would_be_same(options)) {
        REQUIRE(is_same);
        ++same;
      } else {
        ++others, other_meshes += !is_same;
      }
    }
  }
  CHECK(same > 50);
  CHECK(2 * other_meshes > others);
}
