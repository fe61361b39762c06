// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/ear.hpp"

namespace qmorph {
namespace {

constexpr double kSharpCosine = 0.5;  // 60 degrees

double cosine_at(const Region& region, const Ear& ear) {
  const Vec2 a = region.points[ear.before] - region.points[ear.tip],
             b = region.points[ear.after] - region.points[ear.tip];
  return a.dot(b) / (a.norm() * b.norm());
}

}  // namespace

std::optional<Ear> sharpest_ear(const Region& region) {
  std::optional<Ear> sharpest;
  double greatest = kSharpCosine;
  if (region.triangles.size() < 2) return sharpest;
  for (std::size_t t = 0; t < region.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      // Sides i and i + 1 meet at corner i + 1.
      if (!region.open[3 * t + i] || !region.open[3 * t + (i + 1) % 3] || region.open[3 * t + (i + 2) % 3]) continue;
      const auto& n = region.triangles[t];
      const Ear ear{t, n[i], n[(i + 1) % 3], n[(i + 2) % 3]};
      const double cosine = cosine_at(region, ear);
      if (cosine > greatest) sharpest = ear, greatest = cosine;
    }
  return sharpest;
}

Region cut_off(const Region& region, const Ear& ear) {
  Region rest = region;
  const auto t = std::ptrdiff_t(ear.triangle);
  rest.triangles.erase(rest.triangles.begin() + t);
  rest.row.erase(rest.row.begin() + t);
  rest.open.erase(rest.open.begin() + 3 * t, rest.open.begin() + 3 * t + 3);
  for (std::size_t k = 0; k < rest.triangles.size(); ++k)
    for (std::size_t i = 0; i < 3; ++i)
      if (rest.triangles[k][i] == ear.before && rest.triangles[k][(i + 1) % 3] == ear.after)
        rest.open[3 * k + i] = true;
  --rest.boundary_sides;
  return rest;
}

void put_back(kernel::Mesh& mesh, const Ear& ear) { mesh.attach_triangle(mesh.find(ear.after, ear.before), ear.tip); }

}  // namespace qmorph
