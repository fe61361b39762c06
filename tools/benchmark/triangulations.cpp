// SPDX-License-Identifier: GPL-2.0-or-later
#include "triangulations.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <utility>

#include "random.hpp"

namespace benchmark {
namespace {

const double kRowHeight = std::sqrt(3.0) / 2;  // of a lattice with unit edges
constexpr double kJitter = 0.15;               // of an edge, each way
constexpr double kGrading = 100;               // largest size over smallest
constexpr int kTilesEachWay = 10;              // of Kind::many

/// Hexagons whose sides run along lattice lines, so that a hole has a clean boundary.
struct Holes {
  std::vector<Eigen::Vector2d> centres;
  double radius;  // whole number of edges

  Holes(int columns, int rows, int each_way)
      : radius(std::max(1.0, std::floor(kHoleRadius * kHolesEachWay / each_way * columns))) {
    for (int i = 0; i < each_way; ++i)
      for (int j = 0; j < each_way; ++j) {
        const int row = 2 * ((2 * j + 1) * rows / (4 * each_way));  // nodes of even rows have whole x
        const int column = (2 * i + 1) * columns / (2 * each_way);
        centres.emplace_back(column, row * kRowHeight);
      }
  }
  bool contain(const Eigen::Vector2d& p) const {
    for (const auto& c : centres) {
      const double dx = std::abs(p.x() - c.x()), dy = std::abs(p.y() - c.y());
      if (dy < radius * kRowHeight && 2 * kRowHeight * dx + dy < 2 * kRowHeight * radius) return true;
    }
    return false;
  }
};

/// A square with holes; its boundary has an even number of sides. Lengths in edges of the lattice.
struct Lattice {
  int columns = 0, rows = 0;
  std::vector<Eigen::Vector2d> nodes;
  std::vector<int> row;  // of a node
  std::vector<bool> boundary;
  std::vector<std::array<Index, 3>> triangles;
};

/// Rows of nodes, every second one shifted by half an edge, except that the sides stay straight. \return where each row
/// begins
std::vector<std::size_t> place_nodes(Lattice& lattice) {
  std::vector<std::size_t> row_begin;
  for (int r = 0; r <= lattice.rows; ++r) {
    row_begin.push_back(lattice.nodes.size());
    const double y = r * kRowHeight;
    if (r % 2 == 0) {
      for (int c = 0; c <= lattice.columns; ++c) lattice.nodes.emplace_back(c, y);
    } else {
      lattice.nodes.emplace_back(0, y);
      for (int c = 0; c < lattice.columns; ++c) lattice.nodes.emplace_back(c + 0.5, y);
      lattice.nodes.emplace_back(lattice.columns, y);
    }
    lattice.row.resize(lattice.nodes.size(), r);
  }
  row_begin.push_back(lattice.nodes.size());
  return row_begin;
}

/// Zips up the strip between two rows by the shorter edge.
void triangulate_strips(Lattice& lattice, const std::vector<std::size_t>& row_begin, const Holes& holes) {
  const auto& nodes = lattice.nodes;
  for (int r = 0; r < lattice.rows; ++r) {
    std::size_t low = row_begin[r], high = row_begin[r + 1];
    const std::size_t low_end = row_begin[r + 1] - 1, high_end = row_begin[r + 2] - 1;
    while (low < low_end || high < high_end) {
      const bool step_low = high == high_end || (low < low_end && (nodes[low + 1] - nodes[high]).norm() <
                                                                      (nodes[high + 1] - nodes[low]).norm());
      const std::size_t next = step_low ? low + 1 : high + 1;
      if (!holes.contain((nodes[low] + nodes[next] + nodes[high]) / 3))
        lattice.triangles.push_back({Index(low), Index(next), Index(high)});
      (step_low ? low : high) = next;
    }
  }
}

/// A node is on the boundary if its triangles do not close around it; other nodes are jittered, and those inside holes
/// are removed.
void finish_nodes(Lattice& lattice, Random& random) {
  std::vector<double> angle(lattice.nodes.size(), 0);
  for (const auto& t : lattice.triangles)
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector2d a = lattice.nodes[t[(k + 1) % 3]] - lattice.nodes[t[k]];
      const Eigen::Vector2d b = lattice.nodes[t[(k + 2) % 3]] - lattice.nodes[t[k]];
      angle[t[k]] += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
    }
  std::vector<Index> kept(lattice.nodes.size(), qmorph::kNone);
  std::size_t count = 0;
  for (std::size_t i = 0; i < lattice.nodes.size(); ++i) {
    if (angle[i] == 0) continue;  // inside a hole
    Eigen::Vector2d p = lattice.nodes[i];
    const bool boundary = angle[i] <= 6.28;
    if (!boundary) p += Eigen::Vector2d(random.between(-kJitter, kJitter), random.between(-kJitter, kJitter));
    lattice.nodes[count] = p;
    lattice.row[count] = lattice.row[i];
    lattice.boundary.push_back(boundary);
    kept[i] = Index(count++);
  }
  lattice.nodes.resize(count);
  lattice.row.resize(count);
  for (auto& t : lattice.triangles)
    for (Index& node : t) node = kept[node];
}

Lattice make_lattice(double wanted, int holes_each_way, std::uint64_t seed) {
  const double hole_share = kHolesEachWay * kHolesEachWay * 3 * kRowHeight * kHoleRadius * kHoleRadius;
  Lattice lattice;
  lattice.columns =
      std::max(2 * holes_each_way, int(std::lround(std::sqrt(wanted * kRowHeight / 2 / (1 - hole_share)))));
  lattice.rows = 2 * int(std::lround(lattice.columns / kRowHeight / 2));  // even
  const std::vector<std::size_t> row_begin = place_nodes(lattice);
  triangulate_strips(lattice, row_begin, Holes(lattice.columns, lattice.rows, holes_each_way));
  Random random(seed);
  finish_nodes(lattice, random);
  return lattice;
}

Triangulation one_surface(double wanted, bool graded) {
  Lattice lattice = make_lattice(wanted, kHolesEachWay, 1);
  Triangulation mesh;
  for (Eigen::Vector2d p : lattice.nodes) {
    p /= lattice.columns;
    if (graded) {
      const Eigen::Vector2d z = p * std::log(kGrading);
      p = std::exp(z.x()) * Eigen::Vector2d(std::cos(z.y()), std::sin(z.y()));
    }
    mesh.points.emplace_back(p.x(), p.y(), 0);
  }
  mesh.boundary = std::move(lattice.boundary);
  mesh.surfaces.push_back(std::move(lattice.triangles));
  return mesh;
}

/// Tiles fit each other: none of the nodes on their sides is jittered.
Triangulation many_surfaces(double wanted) {
  Triangulation mesh;
  std::map<std::pair<int, int>, Index> shared;  // by half columns and rows of the whole
  for (int tile = 0; tile < kTilesEachWay * kTilesEachWay; ++tile) {
    const int i = tile % kTilesEachWay, j = tile / kTilesEachWay;
    Lattice lattice = make_lattice(wanted / (kTilesEachWay * kTilesEachWay), 1, std::uint64_t(tile) + 1);
    const Eigen::Vector2d origin(i * lattice.columns, j * lattice.rows * kRowHeight);
    std::vector<Index> row_of;
    for (std::size_t n = 0; n < lattice.nodes.size(); ++n) {
      Index row = Index(mesh.points.size());
      if (lattice.boundary[n]) {
        const std::pair key(int(std::lround(2 * (lattice.nodes[n].x() + origin.x()))),
                            j * lattice.rows + lattice.row[n]);
        row = shared.try_emplace(key, row).first->second;
      }
      row_of.push_back(row);
      if (row < mesh.points.size()) continue;
      const Eigen::Vector2d p = (lattice.nodes[n] + origin) / (kTilesEachWay * lattice.columns);
      mesh.points.emplace_back(p.x(), p.y(), 0);
      mesh.boundary.push_back(lattice.boundary[n]);
    }
    for (auto& t : lattice.triangles)
      for (Index& node : t) node = row_of[node];
    mesh.surfaces.push_back(std::move(lattice.triangles));
  }
  return mesh;
}

}  // namespace

const char* name_of(Kind kind) {
  return kind == Kind::even ? "even" : kind == Kind::graded ? "graded" : "many surfaces";
}

std::size_t Triangulation::triangle_count() const {
  std::size_t count = 0;
  for (const auto& surface : surfaces) count += surface.size();
  return count;
}

qmorph::Patch Triangulation::patch(std::size_t surface) const {
  qmorph::Patch patch;
  std::vector<Index> row_of(points.size(), qmorph::kNone);
  for (const auto& t : surfaces[surface])
    for (const Index node : t) row_of[node] = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (row_of[i] != qmorph::kNone) {
      row_of[i] = Index(patch.points.size());
      patch.points.push_back(points[i]);
    }
  for (const auto& t : surfaces[surface]) patch.triangles.push_back({row_of[t[0]], row_of[t[1]], row_of[t[2]]});
  return patch;
}

Triangulation make_triangulation(double wanted, Kind kind) {
  return kind == Kind::many ? many_surfaces(wanted) : one_surface(wanted, kind == Kind::graded);
}

void write_msh2(const Triangulation& mesh, const std::string& path) {
  FILE* file = std::fopen(path.c_str(), "w");
  if (!file) {
    std::perror(path.c_str());
    std::exit(5);
  }
  std::fprintf(file, "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n%zu\n", mesh.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    std::fprintf(file, "%zu %.17g %.17g %.17g\n", i + 1, mesh.points[i].x(), mesh.points[i].y(), mesh.points[i].z());
  std::fprintf(file, "$EndNodes\n$Elements\n%zu\n", mesh.triangle_count());
  std::size_t tag = 0;
  for (std::size_t s = 0; s < mesh.surfaces.size(); ++s)
    for (const auto& t : mesh.surfaces[s])
      std::fprintf(file, "%zu 2 2 %zu %zu %u %u %u\n", ++tag, s + 1, s + 1, t[0] + 1, t[1] + 1, t[2] + 1);
  std::fprintf(file, "$EndElements\n");
  std::fclose(file);
}

}  // namespace benchmark
