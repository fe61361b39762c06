// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/messages/outcome.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <ostream>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "gmsh/read/meshing.hpp"
#include "gmsh/read/raise.hpp"
#include "gmsh/session/session.hpp"
#include "report/summary.hpp"

namespace qmorph::cli {
namespace {

/// Of a list that may have thousands.
constexpr std::size_t kMostNamed = 10;

std::string name_some(std::span<const int> tags) {
  return fmt::format("{}{}", fmt::join(tags.first(std::min(kMostNamed, tags.size())), ", "),
                     tags.size() > kMostNamed ? ", ..." : "");
}

/// What the caller must know in any case, in one line.
void print_outcome(const ModelReport& model, const std::string& output, std::ostream& err) {
  std::string left;
  for (const SurfaceReport& surface : model.surfaces)
    if (surface.outcome == SurfaceOutcome::left) left += fmt::format("{}{}", left.empty() ? "" : ", ", surface.tag);
  if (!left.empty())
    err << fmt::format("qmorph: {} of {} surfaces left as they were: {}\n", model.count(SurfaceOutcome::left),
                       model.surfaces.size(), left);
  else if (model.count(SurfaceOutcome::converted) == 0)
    err << "qmorph: nothing to convert: all surfaces are quads already; " << output << " has them\n";
}

/// What parity forces is not a failure, and the user can do something about it.
void print_triangles(const Request& request, const ModelReport& model, std::ostream& err) {
  if (request.all_quad || request.cleanup_only) return;
  std::size_t triangles = 0;
  std::vector<int> surfaces;
  bool among_quads = false;  // these stay as they are, and what they enclose cannot be split
  for (const SurfaceReport& surface : model.surfaces) {
    if (surface.outcome != SurfaceOutcome::converted || surface.triangles_out == 0) continue;
    triangles += surface.triangles_out;
    among_quads |= surface.quads_in > 0;
    surfaces.push_back(surface.tag);
  }
  if (triangles)
    err << fmt::format(
        "{} triangle{} left where a boundary has an odd number of sides, on surface{} {}; --all-quad "
        "leaves none{}\n",
        triangles, triangles == 1 ? " is" : "s are", surfaces.size() == 1 ? "" : "s", name_some(surfaces),
        among_quads ? " but where quads of the input enclose them; --cleanup-only changes these quads, too" : "");
}

/// Gmsh may repeat a message for each of a million nodes.
void print_once(std::string_view prefix, const std::vector<std::string>& lines, std::ostream& err) {
  std::map<std::string, std::size_t> count;
  for (const std::string& line : lines) ++count[line];
  for (const std::string& line : lines) {
    const std::size_t times = std::exchange(count[line], 0);
    if (times) err << prefix << line << (times > 1 ? fmt::format(" ({} times)", times) : "") << '\n';
  }
}

/// Warnings that only numbers tell apart are of a kind: of a kind that many surfaces have, the first one is printed,
/// with the tags of the others.
class SurfaceWarnings {
 public:
  explicit SurfaceWarnings(const std::vector<SurfaceReport>& surfaces) {
    for (const SurfaceReport& surface : surfaces)
      for (const std::string& warning : surface.warnings) {
        std::vector<int>& tags = of_kind_[kind_of(warning)];
        if (tags.empty() || tags.back() != surface.tag) tags.push_back(surface.tag);
      }
  }

  void print(const SurfaceReport& surface, std::ostream& err) const {
    constexpr std::size_t kMany = 4;
    for (const std::string& warning : surface.warnings) {
      const std::vector<int>& tags = of_kind_.at(kind_of(warning));
      const bool are_many = tags.size() >= kMany;
      if (are_many && tags.front() != surface.tag) continue;
      err << "warning: surface " << surface.tag << ": " << warning;
      if (are_many)
        err << fmt::format("; the like of {} others: {}", tags.size() - 1, name_some(std::span(tags).subspan(1)));
      err << '\n';
    }
  }

 private:
  static std::string kind_of(std::string warning) {
    std::erase_if(warning, [](char c) { return c >= '0' && c <= '9'; });
    return warning;
  }

  std::map<std::string, std::vector<int>> of_kind_;
};

}  // namespace

std::string name_of_input(const Request& request) { return request.from_stdin ? "standard input" : request.input; }

void name_ignored_options(const Request& request, const adapter::OpenedModel& opened, std::ostream& err) {
  const auto warn = [&](const std::string& what) { err << "warning: " << what << '\n'; };
  if (!opened.meshed && request.dimension < 3 && !request.meshing_words.empty())
    warn(fmt::format("Gmsh has nothing to mesh, and {} {} ignored: the elements of {} say how large the quads become",
                     fmt::join(request.meshing_words, ", "), request.meshing_words.size() == 1 ? "is" : "are",
                     name_of_input(request)));
  if (adapter::get_option("Mesh.SubdivisionAlgorithm") != 0)
    warn("Mesh.SubdivisionAlgorithm is ignored: triangles become quads without being divided");
  const int order = static_cast<int>(adapter::get_option("Mesh.ElementOrder")), has = adapter::order_of_surfaces();
  if (request.order_chosen && has > 1 && order > has)
    warn(fmt::format("order {} is ignored: the elements of {} are of order {}, and their curved edges would be lost",
                     order, name_of_input(request), has));
}

void print_summary(const Request& request, const adapter::OpenedModel& opened, const ModelReport& model,
                   const report::RunFacts& facts, const std::string& output, std::ostream& err) {
  if (request.verbosity >= 2) print_once("Gmsh: ", opened.warnings, err);
  if (request.verbosity >= 1) {
    for (const std::string& warning : model.warnings) err << "warning: " << warning << '\n';
    const SurfaceWarnings warnings(model.surfaces);
    for (const SurfaceReport& surface : model.surfaces) {
      err << report::surface_line(surface) << '\n';
      warnings.print(surface, err);
    }
    const std::string division = report::division_line(facts.division, facts.mended);
    if (!division.empty()) err << division << '\n';
    if (facts.even) err << report::even_line(*facts.even) << '\n';
    print_triangles(request, model, err);
    if (facts.volumes.volumes) err << report::volume_line(facts.volumes) << '\n';
    err << report::total_line(model, output, facts.total_seconds) << '\n';
  }
  print_outcome(model, output, err);
}

}  // namespace qmorph::cli
