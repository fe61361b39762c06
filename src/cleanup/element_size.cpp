// SPDX-License-Identifier: GPL-2.0-or-later
#include "cleanup/element_size.hpp"

#include <algorithm>

namespace qmorph::cleanup {

ElementSize::ElementSize(const kernel::Mesh& mesh) : mesh_(mesh), size_(mesh.mean_edges()) {}

double ElementSize::quads_wanted(const std::vector<Index>& quads) const {
  double wanted = 0;
  for (Index f : quads) {
    double area = 0, size = 0;
    Index h = mesh_.half_edge(f);
    const Vec2 p = mesh_.point(mesh_.origin(h));
    for (int i = 0; i < 4; ++i, h = mesh_.next(h)) {
      area += 0.5 * cross(mesh_.point(mesh_.origin(h)) - p, mesh_.point(mesh_.target(h)) - p);
      size += 0.25 * size_[mesh_.origin(h)];
    }
    wanted += area / (size * size);
  }
  return wanted;
}

bool ElementSize::is_uniform(double factor) const {
  std::vector<double> sizes;
  for (Index v = 0; v < mesh_.vertex_slots(); ++v)
    if (mesh_.is_live_vertex(v)) sizes.push_back(size_[v]);
  if (sizes.empty()) return false;
  const auto few = std::ptrdiff_t(sizes.size() / 20);
  const auto small = sizes.begin() + few, large = sizes.end() - 1 - few;
  std::nth_element(sizes.begin(), small, sizes.end());
  std::nth_element(small, large, sizes.end());
  return *large <= factor * *small;
}

double ElementSize::mean(const std::vector<Index>& nodes) const {
  double sum = 0;
  for (Index v : nodes) sum += size_[v];
  return sum / double(nodes.size());
}

void ElementSize::set(Index v, double size) {
  if (v >= size_.size()) size_.resize(v + 1 + v / 2, 0);
  size_[v] = size;
}

}  // namespace qmorph::cleanup
