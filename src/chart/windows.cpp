// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/windows.hpp"

#include <algorithm>
#include <limits>

#include "chart/local_numbers.hpp"
#include "chart/topology.hpp"

namespace qmorph::chart {
namespace {

/// A window that is no disc, or does not lie flat, is tried again with half as many faces.
constexpr std::size_t kSmallest = 8;
constexpr double kMostDistortion = 1.5;

class Taking {
 public:
  Taking(const SurfaceMesh& mesh, const std::vector<Index>& opposite, const std::vector<bool>& is_wall,
         const WindowSize& size, std::vector<char>& waiting, Budget& budget)
      : mesh_(mesh), opposite_(opposite), is_wall_(is_wall), size_(size), waiting_(waiting), budget_(budget) {}

  std::vector<Window> run() {
    std::vector<Window> windows;
    if (budget_.is_spent()) return windows;
    budget_.spend(double(kWorkToLook * mesh_.faces.size()));
    find_strip();
    for (Index f = 0; f < mesh_.faces.size() && !budget_.is_spent(); ++f) {
      if (!in_strip_[f] || !has_waiting(f)) continue;
      if (std::unique_ptr<Window> window = window_around(f)) windows.push_back(std::move(*window));
    }
    return windows;
  }

 private:
  bool has_waiting(Index f) const {
    const Face& face = mesh_.faces[f];
    return std::any_of(face.begin(), face.begin() + degree(face), [&](Index v) { return waiting_[v]; });
  }

  Index across(Index side) const { return opposite_[side] == kNone || is_wall_[side] ? kNone : opposite_[side] / 4; }

  /// Faces that are near a waiting node and in no window yet.
  void find_strip() {
    in_strip_.assign(mesh_.faces.size(), 0);
    in_window_.assign(mesh_.faces.size(), 0);
    std::vector<Index> ring, next;
    for (Index f = 0; f < mesh_.faces.size(); ++f)
      if (has_waiting(f)) in_strip_[f] = 1, ring.push_back(f);
    for (int step = 0; step < size_.reach; ++step, std::swap(ring, next)) {
      next.clear();
      for (Index f : ring)
        for (Index side = 4 * f; side < 4 * f + 4; ++side)
          if (const Index g = across(side); g != kNone && !in_strip_[g]) in_strip_[g] = 1, next.push_back(g);
    }
  }

  std::unique_ptr<Window> window_around(Index first) {
    std::vector<Index> faces{first};
    std::vector<int> steps{0};
    in_strip_[first] = 0;
    for (std::size_t k = 0; k < faces.size(); ++k)
      for (Index side = 4 * faces[k]; side < 4 * faces[k] + 4 && faces.size() < size_.most; ++side) {
        const Index g = across(side);
        if (g == kNone) continue;
        if (in_strip_[g]) in_strip_[g] = 0, faces.push_back(g), steps.push_back(steps[k] + 1);
        if (!size_.apart || !in_window_[g] || steps[k] >= size_.margin) continue;
        give_back(faces, 0);  // when the other window is done, there will be room for the whole window
        return nullptr;
      }
    while (true) {
      auto laid_out = lay_out(faces);
      if (laid_out || faces.size() / 2 < kSmallest) {
        if (!laid_out) give_back(faces, 1);
        settle(first, faces, laid_out.get());
        if (laid_out)
          for (Index f : faces) in_window_[f] = 1;
        if (!laid_out) return nullptr;
        return std::make_unique<Window>(Window{std::move(faces), std::move(laid_out)});
      }
      give_back(faces, faces.size() / 2);
    }
  }

  void give_back(std::vector<Index>& faces, std::size_t keep) {
    for (std::size_t k = keep; k < faces.size(); ++k) in_strip_[faces[k]] = 1;
    faces.resize(keep);
  }

  std::unique_ptr<LaidOut> lay_out(const std::vector<Index>& faces) {
    budget_.spend(double(kWorkToLayOut * faces.size()));
    Piece piece(mesh_, opposite_, is_wall_, faces);
    if (loops_of(piece).size() != 1 || euler_characteristic(piece) != 1) return nullptr;
    auto laid_out = std::make_unique<LaidOut>(std::move(piece), kFewRounds);
    const Flattening& flattening = laid_out->chart.flattening();
    budget_.spend(double(flattening.work));
    if (flattening.flipped > 0 || flattening.distortion > kMostDistortion) return nullptr;
    return laid_out;
  }

  /// The nodes of a window that wait no longer: those of its first face, and all that are far enough inside.
  void settle(Index first, const std::vector<Index>& faces, const LaidOut* laid_out) {
    const Face& face = mesh_.faces[first];
    std::for_each(face.begin(), face.begin() + degree(face), [&](Index v) { waiting_[v] = 0; });
    if (!laid_out) return;
    const LocalNumbers local(faces, mesh_.faces.size());
    std::vector<int> steps(faces.size(), std::numeric_limits<int>::max());
    std::vector<Index> order;
    for (Index k = 0; k < faces.size(); ++k)
      for (Index side = 4 * faces[k]; side < 4 * faces[k] + 4; ++side)
        if (across(side) != kNone && local[across(side)] == kNone && steps[k] != 0) steps[k] = 0, order.push_back(k);
    for (std::size_t i = 0; i < order.size(); ++i)
      for (Index side = 4 * faces[order[i]]; side < 4 * faces[order[i]] + 4; ++side) {
        const Index g = across(side), k = g == kNone ? kNone : local[g];
        if (k != kNone && steps[k] > steps[order[i]] + 1) steps[k] = steps[order[i]] + 1, order.push_back(k);
      }
    const Piece& piece = laid_out->piece;
    std::vector<char> is_shallow(piece.points.size(), 0);
    for (Index k = 0; k < faces.size(); ++k)
      if (steps[k] < size_.margin)
        for (Index i = 0; i < degree(piece.faces[k]); ++i) is_shallow[piece.faces[k][i]] = 1;
    for (Index v = 0; v < piece.points.size(); ++v)
      if (!is_shallow[v]) waiting_[piece.vertex[v]] = 0;
  }

  const SurfaceMesh& mesh_;
  const std::vector<Index>& opposite_;
  const std::vector<bool>& is_wall_;
  const WindowSize& size_;
  std::vector<char>& waiting_;
  Budget& budget_;
  std::vector<char> in_strip_, in_window_;
};

}  // namespace

std::vector<Window> take_windows(const SurfaceMesh& mesh, const std::vector<Index>& opposite,
                                 const std::vector<bool>& is_wall, const WindowSize& size, std::vector<char>& waiting,
                                 Budget& budget) {
  return Taking(mesh, opposite, is_wall, size, waiting, budget).run();
}

}  // namespace qmorph::chart
