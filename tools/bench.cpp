// qmorph_bench: how the cost of a conversion grows with the number of triangles. Run it by tools/bench.
//
// The triangulations are made here and not by Gmsh: a jittered lattice of equilateral triangles with hexagonal holes,
// so that a million triangles take a second and every machine gets the same bits. `graded` is the same domain under
// the conformal map exp(z), which keeps the shape of small triangles while their size varies by a factor of 100.

#include <malloc.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "qmorph/convert.hpp"
#include "qmorph/quality.hpp"

namespace {

using qmorph::Index;
using qmorph::Patch;

const double kRowHeight = std::sqrt(3.0) / 2;  // of a lattice with unit edges
constexpr double kJitter = 0.15;               // of an edge, each way
constexpr int kHolesEachWay = 4;
constexpr double kHoleRadius = 0.06;  // of the domain's side
constexpr double kGrading = 100;      // largest size over smallest

/// SplitMix64 (Steele, Lea, Flood 2014). std::uniform_real_distribution differs between standard libraries.
class Random {
 public:
  double between(double low, double high) {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ull);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    z ^= z >> 31;
    return low + (high - low) * (double(z >> 11) * 0x1p-53);
  }

 private:
  std::uint64_t state_ = 1;
};

/// Hexagons whose sides run along lattice lines, so that a hole has a clean boundary.
struct Holes {
  std::vector<Eigen::Vector2d> centres;
  double radius;  // whole number of edges

  Holes(int columns, int rows) : radius(std::max(1.0, std::floor(kHoleRadius * columns))) {
    for (int i = 0; i < kHolesEachWay; ++i)
      for (int j = 0; j < kHolesEachWay; ++j) {
        const int row = 2 * ((2 * j + 1) * rows / (4 * kHolesEachWay));  // nodes of even rows have whole x
        const int column = (2 * i + 1) * columns / (2 * kHolesEachWay);
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

/// A square domain with holes and about `wanted` triangles; its boundary has an even number of sides.
Patch make_patch(double wanted, bool graded) {
  const double hole_share = kHolesEachWay * kHolesEachWay * 3 * kRowHeight * kHoleRadius * kHoleRadius;
  const int columns =
      std::max(2 * kHolesEachWay, int(std::lround(std::sqrt(wanted * kRowHeight / 2 / (1 - hole_share)))));
  const int rows = 2 * int(std::lround(columns / kRowHeight / 2));  // even
  const Holes holes(columns, rows);

  std::vector<Eigen::Vector2d> nodes;  // in edges of the lattice
  std::vector<std::size_t> row_begin;
  for (int r = 0; r <= rows; ++r) {
    row_begin.push_back(nodes.size());
    const double y = r * kRowHeight;
    if (r % 2 == 0) {
      for (int c = 0; c <= columns; ++c) nodes.emplace_back(c, y);
    } else {  // shifted by half an edge, but the sides stay straight
      nodes.emplace_back(0, y);
      for (int c = 0; c < columns; ++c) nodes.emplace_back(c + 0.5, y);
      nodes.emplace_back(columns, y);
    }
  }
  row_begin.push_back(nodes.size());

  std::vector<std::array<Index, 3>> triangles;
  for (int r = 0; r < rows; ++r) {  // close the strip between two rows like a zip, by the shorter edge
    std::size_t low = row_begin[r], high = row_begin[r + 1];
    const std::size_t low_end = row_begin[r + 1] - 1, high_end = row_begin[r + 2] - 1;
    while (low < low_end || high < high_end) {
      const bool step_low = high == high_end || (low < low_end && (nodes[low + 1] - nodes[high]).norm() <
                                                                      (nodes[high + 1] - nodes[low]).norm());
      const std::size_t next = step_low ? low + 1 : high + 1;
      if (!holes.contain((nodes[low] + nodes[next] + nodes[high]) / 3))
        triangles.push_back({Index(low), Index(next), Index(high)});
      (step_low ? low : high) = next;
    }
  }

  // A node is on the boundary when its triangles do not close around it; those are not jittered.
  std::vector<double> angle(nodes.size(), 0);
  for (const auto& t : triangles)
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector2d a = nodes[t[(k + 1) % 3]] - nodes[t[k]], b = nodes[t[(k + 2) % 3]] - nodes[t[k]];
      angle[t[k]] += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
    }

  Patch patch;
  Random random;
  std::vector<Index> row_of(nodes.size(), qmorph::kNone);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (angle[i] == 0) continue;  // inside a hole
    Eigen::Vector2d p = nodes[i];
    if (angle[i] > 6.28) p += Eigen::Vector2d(random.between(-kJitter, kJitter), random.between(-kJitter, kJitter));
    p /= columns;
    if (graded) {
      const Eigen::Vector2d z = p * std::log(kGrading);
      p = std::exp(z.x()) * Eigen::Vector2d(std::cos(z.y()), std::sin(z.y()));
    }
    row_of[i] = Index(patch.points.size());
    patch.points.emplace_back(p.x(), p.y(), 0);
  }
  for (const auto& t : triangles) patch.triangles.push_back({row_of[t[0]], row_of[t[1]], row_of[t[2]]});
  return patch;
}

/// The triangles as MSH 2.2, for comparing with what other programs make of them.
void write_msh(const Patch& patch, const std::string& path) {
  FILE* file = std::fopen(path.c_str(), "w");
  if (!file) {
    std::perror(path.c_str());
    std::exit(5);
  }
  std::fprintf(file, "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n%zu\n", patch.points.size());
  for (std::size_t i = 0; i < patch.points.size(); ++i)
    std::fprintf(file, "%zu %.17g %.17g %.17g\n", i + 1, patch.points[i].x(), patch.points[i].y(), patch.points[i].z());
  std::fprintf(file, "$EndNodes\n$Elements\n%zu\n", patch.triangles.size());
  for (std::size_t i = 0; i < patch.triangles.size(); ++i) {
    const auto& t = patch.triangles[i];
    std::fprintf(file, "%zu 2 2 1 1 %u %u %u\n", i + 1, t[0] + 1, t[1] + 1, t[2] + 1);
  }
  std::fprintf(file, "$EndElements\n");
  std::fclose(file);
}

/// A line of /proc/self/status in bytes: VmRSS, or VmHWM for the peak; 0 where there is no such file.
double memory(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(name)) return 1024 * std::atof(line.c_str() + name.size() + 1);
  return 0;
}

struct Timing {
  double seconds;
  qmorph::ConversionStats stats;
};

/// Converts once, or three times for the one in the middle: the machine has other things to do, too.
/// Prints a line and returns seconds per triangle; a negative value for a mesh that is not valid.
double run(const char* kind, const Patch& patch, int repeats) {
  std::vector<Timing> timings;
  qmorph::QuadMesh mesh;
  double bytes = 0;  // at the peak, over what the process had before
  for (int i = 0; i < repeats; ++i) {
    mesh = {};
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << 5;  // forget the peak so far
    const double before = memory("VmRSS");
    const auto start = std::chrono::steady_clock::now();
    mesh = qmorph::convert(patch);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    timings.push_back({elapsed.count(), mesh.stats});
    bytes = std::max(bytes, memory("VmHWM") - before);
  }
  std::sort(timings.begin(), timings.end(), [](const Timing& a, const Timing& b) { return a.seconds < b.seconds; });
  const Timing& t = timings[timings.size() / 2];
  const qmorph::Quality quality = qmorph::measure(mesh, Eigen::Vector3d::UnitZ());
  const double per_triangle = t.seconds / double(patch.triangles.size());
  std::printf("%-8s %9zu %8.3f %8.3f %8.3f %8.3f %8.3f %8.2f %9zu %5zu %6.3f %6.3f %5.1f%% %7.0f\n", kind,
              patch.triangles.size(), t.seconds, t.stats.front_seconds, t.stats.elimination_seconds,
              t.stats.cleanup_seconds, t.stats.smoothing_seconds, 1e6 * per_triangle, mesh.quads.size(),
              mesh.triangles.size(), quality.scaled_jacobian_min, quality.scaled_jacobian_mean,
              100 * quality.irregular_share(), bytes / double(patch.triangles.size()));
  std::fflush(stdout);
  if (quality.inverted != 0) {
    std::fprintf(stderr, "bench: %zu inverted elements\n", quality.inverted);
    return -1;
  }
  return per_triangle;
}

}  // namespace

int main(int argc, char** argv) {
  const char* usage =
      "usage: bench [--graded | --even] [--once] [--write FILE.msh] [TRIANGLES...]\n"
      "  Converts triangulations of about so many triangles (10000 100000 1000000), of even and of graded size.\n"
      "  --once: one conversion each instead of the middle one of three\n"
      "  --write FILE.msh: no conversion; the triangles of the first size as a file, for other programs\n";
  std::vector<double> sizes;
  std::vector<bool> kinds{false, true};
  std::string file;
  int repeats = 3;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--graded" || argument == "--even") {
      kinds = {argument == "--graded"};
    } else if (argument == "--once") {
      repeats = 1;
    } else if (argument == "--write" && i + 1 < argc) {
      file = argv[++i];
    } else if (const double size = std::atof(argv[i]); size >= 100) {
      sizes.push_back(size);
    } else {
      std::fputs(usage, argument == "--help" ? stdout : stderr);
      return argument == "--help" ? 0 : 1;
    }
  }
  if (sizes.empty()) sizes = {1e4, 1e5, 1e6};
  if (!file.empty()) {
    write_msh(make_patch(sizes[0], kinds.size() == 1 && kinds[0]), file);
    return 0;
  }

  std::printf("%-8s %9s %8s %8s %8s %8s %8s %8s %9s %5s %6s %6s %6s %7s\n", "sizes", "triangles", "seconds", "front",
              "elimin.", "cleanup", "smooth", "us/tri", "quads", "left", "SJ min", "mean", "irreg.", "B/tri");
  bool valid = true;
  for (const bool graded : kinds) {
    const char* kind = graded ? "graded" : "even";
    std::vector<double> cost;
    for (const double size : sizes) cost.push_back(run(kind, make_patch(size, graded), repeats));
    valid = valid && *std::min_element(cost.begin(), cost.end()) >= 0;
    if (cost.size() > 1)
      std::printf("%-8s cost per triangle, last over first: %.2f\n", kind, cost.back() / cost.front());
  }
  return valid ? 0 : 3;
}
