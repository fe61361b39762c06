// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh_tasks.hpp"

#include <gmsh.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "qmorph/gmsh.hpp"

namespace benchmark {
namespace {

class StopWatch {
 public:
  /// Seconds since the last call.
  double lap() {
    const auto before = std::exchange(start_, std::chrono::steady_clock::now());
    return std::chrono::duration<double>(start_ - before).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

double cpu_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

void start_gmsh() {
  gmsh::initialize(0, nullptr, false);
  for (const auto& [name, value] : std::initializer_list<std::pair<const char*, double>>{
           {"General.Terminal", 0}, {"General.NumThreads", 1}, {"Mesh.MshFileVersion", 4.1}, {"Mesh.Binary", 1}})
    gmsh::option::setNumber(name, value);
}

/// An edge between two nodes on boundaries, and the surface that it bounds.
struct Side {
  Index low, high, surface;
  auto operator<=>(const Side&) const = default;
};

/// Edges that bound surfaces; those that two surfaces share appear once for each, next to each other.
std::vector<Side> find_sides(const Triangulation& mesh) {
  std::vector<Side> edges;
  for (std::size_t s = 0; s < mesh.surfaces.size(); ++s)
    for (const auto& t : mesh.surfaces[s])
      for (int k = 0; k < 3; ++k) {
        const Index a = t[k], b = t[(k + 1) % 3];
        if (mesh.boundary[a] && mesh.boundary[b]) edges.push_back({std::min(a, b), std::max(a, b), Index(s)});
      }
  std::sort(edges.begin(), edges.end());
  std::vector<Side> sides;  // edges with two triangles of one surface are inside
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (i + 1 < edges.size() && edges[i] == edges[i + 1])
      ++i;
    else
      sides.push_back(edges[i]);
  return sides;
}

/// One curve for all that a surface shares with another, and one for what it shares with none.
using Curves =
    std::map<std::pair<Index, Index>, std::vector<std::size_t>>;  // surfaces (or kNone); node tags, two a line

Curves join_sides(const std::vector<Side>& sides) {
  Curves curves;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Side& side = sides[i];
    std::pair<Index, Index> bounds(side.surface, qmorph::kNone);
    if (i + 1 < sides.size() && sides[i + 1].low == side.low && sides[i + 1].high == side.high)
      bounds.second = sides[++i].surface;
    auto& nodes = curves[bounds];
    nodes.insert(nodes.end(), {side.low + 1, side.high + 1});
  }
  return curves;
}

void add_entity_nodes(const Triangulation& mesh, int dim, int tag, const std::vector<std::size_t>& nodes) {
  std::vector<double> xyz;
  xyz.reserve(3 * nodes.size());
  for (const std::size_t node : nodes)
    xyz.insert(xyz.end(), mesh.points[node - 1].data(), mesh.points[node - 1].data() + 3);
  gmsh::model::mesh::addNodes(dim, tag, nodes, xyz);
}

constexpr int kPoint = -1;

/// The tag of the curve that each node is on, or kPoint where it is on several; 0 for inner nodes.
std::vector<int> find_curves_of_nodes(const Curves& curves, std::size_t nodes_in_all) {
  std::vector<int> curve_of(nodes_in_all, 0);
  int tag = 0;
  for (const auto& [bounds, nodes] : curves) {
    ++tag;
    for (const std::size_t node : nodes) {
      int& curve = curve_of[node - 1];
      curve = curve == 0 || curve == tag ? tag : kPoint;
    }
  }
  return curve_of;
}

void build_model(const Triangulation& mesh) {
  const Curves curves = join_sides(find_sides(mesh));
  const std::vector<int> curve_of = find_curves_of_nodes(curves, mesh.points.size());
  std::map<std::size_t, int> points;
  for (std::size_t i = 0; i < curve_of.size(); ++i)
    if (curve_of[i] == kPoint) {
      const int point = int(points.size()) + 1;
      points[i + 1] = gmsh::model::addDiscreteEntity(0, point);
    }

  std::vector<std::vector<int>> bounding(mesh.surfaces.size());
  std::vector<std::vector<std::size_t>> nodes_of_curve(curves.size() + 1);
  int tag = 0;
  for (const auto& [bounds, nodes] : curves) {
    ++tag;
    std::vector<std::size_t> own = nodes;
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    std::vector<int> ends;
    for (const std::size_t node : own)
      if (const auto point = points.find(node); point != points.end()) ends.push_back(point->second);
    std::erase_if(own, [&](std::size_t node) { return curve_of[node - 1] == kPoint; });
    nodes_of_curve[tag] = std::move(own);
    gmsh::model::addDiscreteEntity(1, tag, ends);
    for (const Index surface : {bounds.first, bounds.second})
      if (surface != qmorph::kNone) bounding[surface].push_back(tag);
  }

  // All nodes before the first element: Gmsh builds its index of nodes anew after each call that adds some.
  for (const auto& [node, point] : points) add_entity_nodes(mesh, 0, point, {node});
  for (int curve = 1; curve <= int(curves.size()); ++curve) add_entity_nodes(mesh, 1, curve, nodes_of_curve[curve]);
  std::vector<bool> placed(mesh.points.size(), false);
  std::vector<std::vector<std::size_t>> corners(mesh.surfaces.size());
  for (std::size_t s = 0; s < mesh.surfaces.size(); ++s) {
    std::vector<std::size_t> inside;
    corners[s].reserve(3 * mesh.surfaces[s].size());
    for (const auto& t : mesh.surfaces[s])
      for (const Index node : t) {
        corners[s].push_back(node + 1);
        if (mesh.boundary[node] || placed[node]) continue;
        placed[node] = true;
        inside.push_back(node + 1);
      }
    gmsh::model::addDiscreteEntity(2, int(s) + 1, bounding[s]);
    add_entity_nodes(mesh, 2, int(s) + 1, inside);
  }

  constexpr int kPointElement = 15, kLine = 1, kTriangle = 2;
  for (const auto& [node, point] : points) gmsh::model::mesh::addElementsByType(point, kPointElement, {}, {node});
  tag = 0;
  for (const auto& [bounds, nodes] : curves) gmsh::model::mesh::addElementsByType(++tag, kLine, {}, nodes);
  for (std::size_t s = 0; s < mesh.surfaces.size(); ++s) {
    gmsh::model::mesh::addElementsByType(int(s) + 1, kTriangle, {}, corners[s]);
    corners[s] = {};
  }
}

std::size_t count_triangles() {
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> elements, nodes;
  gmsh::model::mesh::getElements(types, elements, nodes, 2);
  std::size_t count = 0;
  for (const auto& tags : elements) count += tags.size();
  return count;
}

/// Opens, does the work, writes.
template <class Work>
Figures pass_through(const std::string& in, const std::string& out, Work work) {
  start_gmsh();
  Figures figures;
  double before = cpu_seconds();
  const auto cpu_lap = [&before] { return cpu_seconds() - std::exchange(before, cpu_seconds()); };
  gmsh::open(in);
  figures.open = cpu_lap();
  StopWatch watch;
  work(figures);
  figures.work = watch.lap();
  figures.cpu = cpu_lap();
  gmsh::write(out);
  figures.write = cpu_lap();
  return figures;
}

}  // namespace

Figures write_triangles(const Triangulation& mesh, const std::string& path) {
  start_gmsh();
  Figures figures;
  build_model(mesh);
  gmsh::write(path);
  return figures;
}

Figures gmsh_meshes(double wanted, const std::string& path) {
  start_gmsh();
  namespace geo = gmsh::model::geo;
  const auto polygon = [](const std::vector<Eigen::Vector2d>& corners) {
    std::vector<int> points, lines;
    for (const auto& p : corners) points.push_back(geo::addPoint(p.x(), p.y(), 0));
    for (std::size_t i = 0; i < points.size(); ++i)
      lines.push_back(geo::addLine(points[i], points[(i + 1) % points.size()]));
    return geo::addCurveLoop(lines);
  };
  std::vector<int> loops{polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}})};
  for (int i = 0; i < kHolesEachWay * kHolesEachWay; ++i) {
    const Eigen::Vector2d centre((i % kHolesEachWay + 0.5) / kHolesEachWay, (i / kHolesEachWay + 0.5) / kHolesEachWay);
    std::vector<Eigen::Vector2d> corners;
    for (int k = 0; k < 6; ++k)
      corners.push_back(centre + kHoleRadius * Eigen::Vector2d(std::cos(k * std::numbers::pi / 3),
                                                               std::sin(k * std::numbers::pi / 3)));
    loops.push_back(polygon(corners));
  }
  geo::addPlaneSurface(loops);
  geo::synchronize();
  const double triangle = 0.9 / wanted;  // area; the holes are a tenth or so
  const double size = std::sqrt(triangle * 4 / std::sqrt(3.0));
  for (const char* name : {"Mesh.CharacteristicLengthMin", "Mesh.CharacteristicLengthMax"})
    gmsh::option::setNumber(name, size);
  gmsh::option::setNumber("Mesh.Algorithm", 6);
  Figures figures;
  StopWatch watch;
  const double cpu = cpu_seconds();
  gmsh::model::mesh::generate(2);
  figures.work = watch.lap();
  figures.cpu = cpu_seconds() - cpu;
  figures.triangles = count_triangles();
  gmsh::write(path);
  return figures;
}

Figures gmsh_recombines(const std::string& in, const std::string& out, int algorithm) {
  return pass_through(in, out, [&](Figures&) {
    gmsh::option::setNumber("Mesh.RecombinationAlgorithm", algorithm);
    gmsh::model::mesh::recombine();
  });
}

Figures qmorph_recombines(const std::string& in, const std::string& out, int threads) {
  return pass_through(in, out, [&](Figures& figures) {
    qmorph::Options options;
    options.threads = threads;
    const qmorph::ModelReport report = qmorph::gmsh::recombine(options);
    if (report.count(qmorph::SurfaceOutcome::left) != 0) throw std::runtime_error("a surface was not converted");
    figures.read = report.read_seconds;
    figures.convert = report.convert_seconds;
    figures.check = report.check_seconds;
    figures.replace = report.replace_seconds;
    for (const qmorph::SurfaceReport& surface : report.surfaces) {
      figures.front += surface.conversion.front_seconds + surface.conversion.elimination_seconds;
      figures.cleanup += surface.conversion.cleanup_seconds;
      figures.smoothing += surface.conversion.smoothing_seconds;
    }
  });
}

}  // namespace benchmark
