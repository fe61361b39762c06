// SPDX-License-Identifier: GPL-2.0-or-later
#include "support/dump.hpp"

#include <fstream>
#include <stdexcept>

namespace qmorph::test {
namespace {

// Element types and the one surface, curve and point that they belong to.
constexpr int kPoint = 15, kLine = 1, kTriangle = 2, kQuad = 3, kEntity = 1;

void write(const Patch& arrays, const std::string& path) {
  std::ofstream file(path);
  if (!file) throw std::runtime_error("cannot write " + path);
  file.precision(17);
  file << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" << arrays.points.size() << "\n";
  for (std::size_t i = 0; i < arrays.points.size(); ++i)
    file << i + 1 << " " << arrays.points[i].x() << " " << arrays.points[i].y() << " " << arrays.points[i].z() << "\n";
  file << "$EndNodes\n$Elements\n"
       << arrays.fixed.size() + arrays.constraints.size() + arrays.triangles.size() + arrays.quads.size() << "\n";
  std::size_t tag = 0;
  const auto element = [&](int type, const auto& nodes) {
    file << ++tag << " " << type << " 2 " << kEntity << " " << kEntity;
    for (const Index i : nodes) file << " " << i + 1;
    file << "\n";
  };
  for (const Index i : arrays.fixed) element(kPoint, std::array<Index, 1>{i});
  for (const auto& nodes : arrays.constraints) element(kLine, nodes);
  for (const auto& nodes : arrays.triangles) element(kTriangle, nodes);
  for (const auto& nodes : arrays.quads) element(kQuad, nodes);
  file << "$EndElements\n";
}

}  // namespace

void dump(const Patch& patch, const std::string& path) { write(patch, path); }

void dump(const Patch& patch, const QuadMesh& mesh, const std::string& path) {
  std::vector<Index> row(patch.points.size(), kNone);
  for (Index i = 0; i < mesh.source.size(); ++i)
    if (mesh.source[i] != kNone) row.at(mesh.source[i]) = i;
  Patch arrays{mesh.points, mesh.triangles, mesh.quads, {}, {}};
  for (const auto& [a, b] : patch.constraints)
    if (row[a] != kNone && row[b] != kNone) arrays.constraints.push_back({row[a], row[b]});
  for (const Index i : patch.fixed)
    if (row[i] != kNone) arrays.fixed.push_back(row[i]);
  write(arrays, path);
}

}  // namespace qmorph::test
