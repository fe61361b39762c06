// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/divide.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>

#include "chart/coarse.hpp"
#include "chart/cutting_plane.hpp"
#include "chart/local_numbers.hpp"
#include "chart/opening.hpp"
#include "chart/topology.hpp"

namespace qmorph::chart {
namespace {

/// What is larger than this times the size that parts are to have is cut.
constexpr double kTooLarge = 1.5;
/// A piece of a part with less than this share of its faces goes to a neighbour.
constexpr double kCrumb = 0.1;
/// Quads that are squares in a chart are good quads in space up to this distortion. Parts with few faces may have more:
/// cut again, they would be all interface.
constexpr double kMostDistortion = 1.2, kMostOfFew = 2;
constexpr double kMany = 200, kFew = 30;
/// Of a part with very many faces, quads are small beside the surface's curves, and smoothing in space makes up for
/// more: fewer cuts leave fewer irregular nodes, and take less time.
constexpr double kMostOfVeryMany = 1.3;
constexpr std::size_t kVeryMany = 1500;
/// Faces of a part that is looked at before it is laid flat, which costs more.
constexpr std::size_t kLarge = 500;
/// Of one that is judged by a few of its points, if that will do.
constexpr std::size_t kVeryLarge = 2000;

class Dividing {
 public:
  Dividing(const SurfaceMesh& mesh, const std::vector<Index>& opposite, std::vector<bool> is_cut,
           const DivisionSettings& settings)
      : mesh_(mesh), opposite_(opposite), most_(double(settings.most_faces)), settings_(settings) {
    division_.is_cut = std::move(is_cut);
  }

  Division run() {
    std::vector<Index> all(mesh_.faces.size());
    std::iota(all.begin(), all.end(), 0);
    std::vector<std::vector<Index>> waiting = components(all, opposite_, division_.is_cut);
    std::reverse(waiting.begin(), waiting.end());
    while (!waiting.empty()) {
      const std::vector<Index> faces = std::move(waiting.back());
      waiting.pop_back();
      std::vector<std::vector<Index>> smaller = settle(faces);
      std::move(smaller.rbegin(), smaller.rend(), std::back_inserter(waiting));
    }
    return std::move(division_);
  }

 private:
  double most_distortion(std::size_t faces) const {
    if (faces >= kVeryMany && !settings_.keeps_lengths) return kMostOfVeryMany;
    const double few = std::clamp((kMany - double(faces)) / (kMany - kFew), 0.0, 1.0);
    return kMostDistortion + few * (kMostOfFew - kMostDistortion);
  }

  bool is_good(const LaidOut& part) const {
    const Flattening& flattening = part.chart.flattening();
    return flattening.flipped == 0 && flattening.distortion <= most_distortion(part.piece.faces.size());
  }

  struct Judged {
    bool is_good;
    std::unique_ptr<LaidOut> laid_out;  ///< with the piece; null if a glance was enough, and then the piece stays
  };
  Judged judge(Piece& piece) const {
    if (settings_.at_a_glance && piece.faces.size() >= kVeryLarge && !may_have_narrow_tip(piece))
      if (const auto distortion = coarse_distortion(piece))
        return {*distortion <= most_distortion(piece.faces.size()), nullptr};
    auto part = std::make_unique<LaidOut>(std::move(piece));
    const bool good = is_good(*part);
    return {good, std::move(part)};
  }

  /// A disc whose total curvature is so large that there is no point in trying: half a sphere has 2 pi. Tips may be cut
  /// open.
  static bool is_round(const Piece& piece, const std::vector<double>& defects) {
    constexpr double kMostInSum = 5, kTip = 0.5;
    if (piece.faces.size() < kLarge) return false;
    std::vector<char> is_outer(piece.points.size(), 0);
    for (Index side = 0; side < piece.open.size(); ++side)
      if (piece.open[side]) is_outer[piece.faces[side / 4][side % 4]] = 1;
    double sum = 0;
    for (Index v = 0; v < defects.size(); ++v)
      if (!is_outer[v] && std::abs(defects[v]) < kTip) sum += defects[v];
    return std::abs(sum) > kMostInSum;
  }

  /// A surface with several rims that cannot lie flat before it is opened: rims of a flat one turn by 2 pi, the outer
  /// one to the left, the others to the right; those of a tube do not turn.
  static bool has_to_be_opened(const Piece& piece, const std::vector<double>& turns) {
    constexpr double kMostAmiss = 4;
    if (piece.faces.size() < kLarge) return false;
    const std::vector<std::vector<Index>> loops = loops_of(piece);
    if (loops.size() < 2) return false;
    std::vector<double> sums;
    for (const std::vector<Index>& loop : loops) {
      double sum = 0;
      for (Index v : loop) sum += turns[v];
      sums.push_back(sum);
    }
    std::sort(sums.rbegin(), sums.rend());
    const double full = 2 * std::numbers::pi;
    return std::abs(sums.front() - full) > kMostAmiss || std::abs(sums.back() + full) > kMostAmiss;
  }

  void accept(const std::vector<Index>& faces, std::unique_ptr<LaidOut> part) {
    division_.parts.push_back(faces);
    division_.laid_out.push_back(std::move(part));
  }

  /// Accepts a part, or cuts it and returns what it falls into.
  std::vector<std::vector<Index>> settle(const std::vector<Index>& faces) {
    Piece piece(mesh_, opposite_, division_.is_cut, faces);
    bool is_to_be_cut = double(faces.size()) > kTooLarge * most_ || !is_planar_topology(piece);
    const std::vector<double> defects = is_to_be_cut ? std::vector<double>() : angle_defects(piece);
    is_to_be_cut = is_to_be_cut || is_round(piece, defects);
    if (is_to_be_cut || has_to_be_opened(piece, defects)) {
      if (auto opened = is_to_be_cut ? std::nullopt : open(faces, piece, defects))
        return finish(faces, std::move(*opened));
      auto smaller = cut(faces, piece);
      if (smaller.empty()) accept(faces, std::make_unique<LaidOut>(std::move(piece)));
      return smaller;
    }
    auto [is_good, part] = judge(piece);
    if (is_good) return finish(faces, std::move(part));
    const Piece& same = part ? part->piece : piece;
    if (auto opened = open(faces, same, defects)) return finish(faces, std::move(*opened));
    auto smaller = cut(faces, same);
    if (smaller.empty()) accept(faces, part ? std::move(part) : std::make_unique<LaidOut>(std::move(piece)));
    return smaller;
  }

  void set_cut(Index side, bool cut) { division_.is_cut[side] = division_.is_cut[opposite_[side]] = cut; }

  /// Accepts a part that lies flat, but for tips that have to be cut first. Where a tip is narrow between cuts on every
  /// way from it, there is nothing left to cut.
  std::vector<std::vector<Index>> finish(const std::vector<Index>& faces, std::unique_ptr<LaidOut> part) {
    std::vector<Index> sides;
    if (part) sides = sides_along(part->piece, path_from_narrow_tip(part->piece, part->chart.flat()));
    if (sides.empty()) {
      accept(faces, std::move(part));
      return {};
    }
    for (Index side : sides) set_cut(side, true);
    return components(faces, opposite_, division_.is_cut);
  }

  /// Cuts along the paths that open the part, until it has a good chart; null in its place if a glance was enough.
  /// Nothing, and nothing is cut, if it never has.
  std::optional<std::unique_ptr<LaidOut>> open(const std::vector<Index>& faces, const Piece& piece,
                                               const std::vector<double>& defects) {
    std::vector<Index> sides;
    const std::vector<std::vector<Index>> paths = opening_paths(piece, defects);
    for (std::size_t k = 0; k < paths.size(); ++k) {
      for (Index side : sides_along(piece, paths[k])) {
        set_cut(side, true);
        sides.push_back(side);
      }
      if (!std::has_single_bit(k + 1) && k + 1 < paths.size())
        continue;  // a surface with many holes is not laid flat for each
      Piece opened(mesh_, opposite_, division_.is_cut, faces);
      if (auto [is_good, part] = judge(opened); is_good) return std::move(part);
    }
    for (Index side : sides) set_cut(side, false);
    return {};
  }

  std::vector<Index> sides_along(const Piece& piece, const std::vector<Index>& path) const {
    std::vector<std::pair<Index, Index>> edges;
    for (std::size_t k = 0; k + 1 < path.size(); ++k) edges.emplace_back(path[k], path[k + 1]);
    std::sort(edges.begin(), edges.end());
    std::vector<Index> sides;
    for (Index side = 0; side < piece.open.size(); ++side) {
      const Face& face = piece.faces[side / 4];
      if (side % 4 >= degree(face) || piece.open[side]) continue;
      const Index a = face[side % 4], b = face[next_corner(face, side % 4)];
      if (std::binary_search(edges.begin(), edges.end(), std::pair(a, b)))
        sides.push_back(4 * piece.row[side / 4] + side % 4);
    }
    return sides;
  }

  /// Cuts the part along a plane. Nothing if that leaves it whole.
  std::vector<std::vector<Index>> cut(const std::vector<Index>& faces, const Piece& piece) {
    const double parts = std::max(2.0, std::round(double(faces.size()) / most_));
    const std::vector<char> beyond = sides_of_best_plane(piece, std::floor(parts / 2) / parts);
    const LocalNumbers local(faces, mesh_.faces.size());
    std::vector<Index> interface;
    for (Index f : faces)
      for (Index side = 4 * f; side < 4 * f + 4; ++side) {
        const Index other = opposite_[side];
        if (other == kNone || other < side || division_.is_cut[side]) continue;
        const Index here = local[f], there = local[other / 4];
        if (there == kNone || beyond[here] == beyond[there]) continue;
        interface.push_back(side);
        set_cut(side, true);
      }
    merge_crumbs(faces, interface);
    auto pieces = components(faces, opposite_, division_.is_cut);
    if (pieces.size() > 1) return pieces;
    for (Index side : interface) set_cut(side, false);
    return {};
  }

  /// The smallest pieces first.
  void merge_crumbs(const std::vector<Index>& faces, const std::vector<Index>& interface) {
    for (bool merged = true; merged;) {
      merged = false;
      auto pieces = components(faces, opposite_, division_.is_cut);
      std::stable_sort(pieces.begin(), pieces.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
      const double all = double(faces.size()), crumb = std::max(kCrumb * all, std::min(kFew / 3, all / 5));
      if (pieces.size() <= 2 || double(pieces[0].size()) >= crumb) return;
      const LocalNumbers local(faces, mesh_.faces.size());
      std::vector<Index> of(faces.size(), kNone);
      for (Index p = 0; p < pieces.size(); ++p)
        for (Index f : pieces[p]) of[local[f]] = p;
      std::map<Index, std::vector<Index>> borders;  // of the smallest piece, by what lies beyond
      for (Index side : interface) {
        const Index p = of[local[side / 4]], q = of[local[opposite_[side] / 4]];
        if (division_.is_cut[side] && p != q && (p == 0 || q == 0)) borders[std::max(p, q)].push_back(side);
      }
      const auto longest = std::max_element(borders.begin(), borders.end(), [](const auto& a, const auto& b) {
        return a.second.size() < b.second.size();
      });
      if (longest == borders.end()) return;
      for (Index side : longest->second) set_cut(side, false);
      merged = true;
    }
  }

  const SurfaceMesh& mesh_;
  const std::vector<Index>& opposite_;
  const double most_;
  const DivisionSettings settings_;
  Division division_;
};

}  // namespace

Division divide(const SurfaceMesh& mesh, const std::vector<Index>& opposite, std::vector<bool> is_cut,
                const DivisionSettings& settings) {
  return Dividing(mesh, opposite, std::move(is_cut), settings).run();
}

}  // namespace qmorph::chart
