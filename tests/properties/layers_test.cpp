// SPDX-License-Identifier: GPL-2.0-or-later
// Random domains with layers of which it is known which quads they are halves of.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>

#include "qmorph/convert.hpp"
#include "quality/directed_size.hpp"
#include "support/domains.hpp"
#include "support/draft.hpp"
#include "support/invariants.hpp"
#include "support/layered.hpp"
#include "support/seeds.hpp"

namespace {

using qmorph::Index;
using qmorph::kNone;
using qmorph::QuadMesh;
using qmorph::test::allows_laws;
using qmorph::test::layered_domain;
using qmorph::test::LayeredDomain;
using qmorph::test::seeds;

using Quad = std::array<Index, 4>;

Quad sorted(Quad quad) {
  std::sort(quad.begin(), quad.end());
  return quad;
}

/// The quads of a result that are layers, by nodes of the input.
class KeptLayers {
 public:
  KeptLayers(const QuadMesh& mesh, std::size_t layer_quads) {
    for (std::size_t q = 0; q < layer_quads; ++q) {
      std::vector<Index> old_nodes, new_nodes;
      for (Index v : mesh.quads[q])
        mesh.source[v] == kNone ? new_nodes.push_back(v) : old_nodes.push_back(mesh.source[v]);
      std::sort(old_nodes.begin(), old_nodes.end());
      std::sort(new_nodes.begin(), new_nodes.end());
      if (new_nodes.empty())
        whole_.insert({old_nodes[0], old_nodes[1], old_nodes[2], old_nodes[3]});
      else if (new_nodes.size() == 2)
        halves_[{old_nodes[0], old_nodes[1]}].insert({new_nodes[0], new_nodes[1]});
    }
  }

  bool has(const Quad& quad) const { return whole_.contains(sorted(quad)) || is_cut(quad); }
  /// In two, from the wall outwards.
  bool is_cut(const Quad& quad) const {
    const auto left = halves_.find(std::minmax(quad[0], quad[3])), right = halves_.find(std::minmax(quad[1], quad[2]));
    if (left == halves_.end() || right == halves_.end()) return false;
    return std::any_of(left->second.begin(), left->second.end(),
                       [&](const auto& new_nodes) { return right->second.contains(new_nodes); });
  }
  std::size_t whole() const { return whole_.size(); }

 private:
  std::set<Quad> whole_;
  std::map<std::pair<Index, Index>, std::set<std::pair<Index, Index>>> halves_;
};

double aspect(const LayeredDomain& domain, const Quad& quad) {
  const auto length = [&](std::size_t i, std::size_t j) {
    return (domain.patch.points[quad[i]] - domain.patch.points[quad[j]]).norm();
  };
  return (length(0, 1) + length(2, 3)) / (length(1, 2) + length(3, 0));
}

/// Nodes of layers that are not where they were. Where no more than three quads meet, as at the tips of fans, they may
/// have gone outwards.
std::size_t count_moved(const QuadMesh& mesh, std::size_t layer_quads, const qmorph::Patch& patch) {
  std::map<Index, std::size_t> quads_at;
  for (std::size_t q = 0; q < layer_quads; ++q)
    for (Index v : mesh.quads[q]) ++quads_at[v];
  std::size_t count = 0;
  for (const auto& [v, quads] : quads_at)
    count += quads != 3 && mesh.source[v] != kNone && mesh.points[v] != patch.points[mesh.source[v]];
  return count;
}

}  // namespace

TEST_CASE("layers: 300 random domains keep every row, and what is between layers becomes good quads") {
  std::size_t truth = 0, kept = 0, tips = 0, whole_truth = 0, whole = 0, cut = 0, domains_with_cuts = 0;
  for (std::uint64_t seed = 0; seed < seeds(300); ++seed) {
    const LayeredDomain domain = layered_domain(seed);
    const auto [mesh, report] = qmorph::convert(domain.patch);
    CAPTURE(seed);
    CAPTURE(domain.kind);
    const auto broken = qmorph::test::broken_invariants(domain.patch, mesh);
    CHECK_MESSAGE(broken.empty(), broken.front());

    const KeptLayers layers(mesh, report.layer_quads);
    std::size_t lost_thin = 0, lost_on_wall = 0, cut_here = 0;
    for (const Quad& quad : domain.quads) {
      const bool is_kept = layers.has(quad);
      kept += is_kept;
      cut_here += is_kept && layers.is_cut(quad);
      lost_thin += !is_kept && aspect(domain, quad) > 3;
    }
    for (Index q : domain.wall_quads) lost_on_wall += !layers.has(domain.quads[q]);
    CHECK(lost_thin == 0);
    CHECK(lost_on_wall == 0);
    truth += domain.quads.size();
    cut += cut_here;
    domains_with_cuts += cut_here > 0;
    whole_truth += domain.quads.size() - cut_here;
    tips += domain.tip_triangles / 2;
    whole += layers.whole();

    const auto others = std::span(mesh.quads).subspan(report.layer_quads);
    CHECK(qmorph::test::smallest_sine(mesh.points, others) > 0.3);
  }
  CHECK(double(kept) >= 0.98 * double(truth));
  CHECK(double(whole) <= 1.01 * double(whole_truth) + double(tips));
  CHECK(cut > 0);  // columns at fans with an odd number of triangles at the tip
  CHECK(double(domains_with_cuts) < 0.4 * double(seeds(300)));
}

TEST_CASE("layers: a column keeps its rows where a large triangle lies beyond its last one") {
  const LayeredDomain domain = layered_domain(1048);  // the column's last row and the triangle looked like a cell, too
  const auto [mesh, report] = qmorph::convert(domain.patch);
  const KeptLayers layers(mesh, report.layer_quads);
  for (const Quad& quad : domain.quads) CHECK(layers.has(quad));
}

TEST_CASE("layers: nodes of layers stay where they are but at tips, in any position in space") {
  for (std::uint64_t seed = 0; seed < seeds(40); ++seed) {
    const LayeredDomain domain = layered_domain(seed);
    qmorph::test::Rng rng(~seed);
    const qmorph::Patch moved = qmorph::test::moved(domain.patch, rng.between(0.1, 10),
                                                    qmorph::test::random_rotation(rng), Eigen::Vector3d(1, 2, 3));
    const auto flat = qmorph::convert(domain.patch).report;
    const auto [mesh, report] = qmorph::convert(moved);
    CAPTURE(seed);
    CAPTURE(domain.kind);
    CHECK(report.layer_quads == flat.layer_quads);
    CHECK(count_moved(mesh, report.layer_quads, moved) == 0);
  }
}

TEST_CASE("layers: on a cylinder they are those of the plane that was rolled up, and so is what lies between them") {
  std::size_t flat_quads = 0, quads = 0;
  for (std::uint64_t seed = 0; seed < seeds(40); ++seed) {
    const LayeredDomain domain = layered_domain(seed);
    qmorph::Patch rolled = domain.patch;
    for (Eigen::Vector3d& p : rolled.points) p = {std::sin(p.x()), p.y(), std::cos(p.x())};
    const auto flat = qmorph::convert(domain.patch);
    const auto [mesh, report] = qmorph::convert(rolled);
    CAPTURE(seed);
    CAPTURE(domain.kind);
    CHECK(report.layer_quads == flat.report.layer_quads);
    CHECK(mesh.triangles.size() == flat.mesh.triangles.size());
    CHECK(count_moved(mesh, report.layer_quads, rolled) == 0);
    QuadMesh unrolled = mesh;
    for (Eigen::Vector3d& p : unrolled.points) p = {std::atan2(p.x(), p.z()), p.y(), 0};
    const auto others = std::span(mesh.quads).subspan(report.layer_quads);
    CHECK(qmorph::test::smallest_sine(unrolled.points, others) > 0.3);
    flat_quads += flat.mesh.quads.size();
    quads += mesh.quads.size();
  }
  CHECK(double(quads) == doctest::Approx(double(flat_quads)).epsilon(0.05));
}

TEST_CASE(
    "layers: one thread and two make the same bytes, and turned over or renumbered domains have nearly the same "
    "layers") {
  for (std::uint64_t seed = 0; seed < seeds(40); ++seed) {
    const LayeredDomain domain = layered_domain(seed);
    qmorph::Options options;
    options.threads = 1;
    const auto [one, report] = qmorph::convert(domain.patch, options);
    options.threads = 2;
    const QuadMesh two = qmorph::convert(domain.patch, options).mesh;
    CAPTURE(seed);
    CAPTURE(domain.kind);
    REQUIRE(one.points.size() == two.points.size());
    CHECK(one.quads == two.quads);
    CHECK(std::memcmp(one.points.data(), two.points.data(), sizeof(Eigen::Vector3d) * one.points.size()) == 0);
    // The order decides where two rows could go on, and which spoke of a fan is cut.
    qmorph::test::Rng rng(seed);
    for (const auto& patch : {qmorph::test::turned_over(domain.patch), qmorph::test::renumbered(domain.patch, rng)})
      CHECK(double(qmorph::convert(patch).report.layer_quads) ==
            doctest::Approx(double(report.layer_quads)).epsilon(0.03));
  }
}

TEST_CASE("layers: ordinary random domains have almost none") {
  std::size_t triangles = 0, layer_quads = 0;
  for (std::uint64_t seed = 0; seed < seeds(200, 60); ++seed) {
    const auto patch = qmorph::test::random_domain(seed).patch;
    qmorph::Options options;
    options.retry_triangles = 0;
    triangles += patch.triangles.size();
    layer_quads += qmorph::convert(patch, options).report.layer_quads;
  }
  CHECK(double(layer_quads) < 0.02 * double(triangles));  // strips and ribbons are among them
}

TEST_CASE("stretched triangles: outside of layers they become quads of the same sizes, as stretched as the triangles") {
  std::size_t flat_quads = 0, quads = 0, flat_kept = 0, kept = 0;
  const auto is_kept = [](const qmorph::Patch& before, const QuadMesh& after) {
    return largest_ratio(median(qmorph::directed_sizes(before, after.points, after.quads))) <=
           qmorph::kLargestSizeRatio;
  };
  for (std::uint64_t seed = 0; seed < seeds(60); ++seed) {
    const auto domain = qmorph::test::random_domain(seed);
    qmorph::test::Rng rng(seed);
    const double angle = rng.between(0, 3), stretch = std::pow(10, rng.between(1, 3));
    const Eigen::Vector3d along(std::cos(angle), std::sin(angle), 0);
    qmorph::Patch patch = domain.patch;
    for (Eigen::Vector3d& p : patch.points) p += (stretch - 1) * p.dot(along) * along;
    qmorph::Options options;
    options.retry_triangles = 0;
    const auto flat = qmorph::convert(domain.patch, options).mesh;
    const auto mesh = qmorph::convert(patch, options).mesh;
    CAPTURE(seed);
    CAPTURE(domain.kind);
    CAPTURE(stretch);
    const auto broken = qmorph::test::broken_invariants(patch, mesh);
    CHECK_MESSAGE(broken.empty(), broken.front());
    flat_quads += flat.quads.size();
    quads += mesh.quads.size();
    flat_kept += is_kept(domain.patch, flat);
    kept += is_kept(patch, mesh);
  }
  if (!allows_laws(seeds(60))) return;
  CHECK(double(kept) > 0.9 * double(flat_kept));
  CHECK(double(quads) == doctest::Approx(double(flat_quads)).epsilon(0.1));
}
