#include "cleanup/element_size.hpp"

#include <algorithm>

namespace qmorph::cleanup {

ElementSize::ElementSize(const kernel::Mesh& mesh) : mesh_(mesh), size_(mesh.vertex_slots(), 0) {
  for (Index v = 0; v < mesh.vertex_slots(); ++v)
    if (mesh.is_live_vertex(v)) size_[v] = mesh.mean_edge(v);
}

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
  std::sort(sizes.begin(), sizes.end());
  const std::size_t few = sizes.size() / 20;
  return !sizes.empty() && sizes[sizes.size() - 1 - few] <= factor * sizes[few];
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
