// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/divide_region.hpp"

#include <algorithm>
#include <numeric>

#include "chart/refine.hpp"
#include "chart/topology.hpp"
#include "engine/budget.hpp"

namespace qmorph::chart {
namespace {

class RegionDividing {
 public:
  RegionDividing(const CurvedRegion& region, const Ground& ground, const RegionDivision& settings)
      : region_(region), ground_(ground), settings_(settings) {}

  DividedRegion run() {
    divide_region(settings_.straightens);
    const auto& parts = result_.division.laid_out;
    if (settings_.straightens &&
        std::any_of(parts.begin(), parts.end(), [](const auto& p) { return is_turned_over(*p); }))
      divide_region(false);
    return std::move(result_);
  }

 private:
  void divide_region(bool straightens) {
    auto& [mesh, creases, interface, division, work] = result_;
    mesh = region_.start();
    for (int i = 0; i < settings_.refinings; ++i) mesh = refined(mesh, region_.creases);
    opposite_ = opposite_sides(mesh);
    const std::vector<bool> is_crease = sides_on(mesh, region_.creases);
    creases = edges_on(mesh, is_crease);
    division =
        divide(mesh, opposite_, is_crease, {.at_a_glance = straightens, .keeps_lengths = ground_.field != nullptr});
    std::vector<bool> is_interface = division.is_cut;
    for (std::size_t side = 0; side < is_interface.size(); ++side)
      if (is_crease[side]) is_interface[side] = false;
    interface = edges_on(mesh, is_interface);
    if (!interface.empty() && straightens) straighten_interfaces();
    const std::vector<char> changed =
        make_parts_even(mesh, opposite_, division, creases, interface, *region_.background);
    for (Index p = 0; p < division.parts.size(); ++p)
      if (changed[p] || !division.laid_out[p])
        division.laid_out[p] = std::make_unique<LaidOut>(mesh, opposite_, division.is_cut, division.parts[p]);
  }

  void straighten_interfaces() {
    auto& [mesh, creases, interface, division, work] = result_;
    Budget budget(settings_.most_work);
    straighten(mesh, creases, interface, ground_, budget);
    work += budget.spent();
    opposite_ = opposite_sides(mesh);
    division.is_cut = sides_on(mesh, interface);
    const std::vector<bool> is_crease = sides_on(mesh, creases);
    for (std::size_t side = 0; side < is_crease.size(); ++side)
      if (is_crease[side]) division.is_cut[side] = true;
    std::vector<Index> all(mesh.faces.size());
    std::iota(all.begin(), all.end(), 0);
    division.parts = components(all, opposite_, division.is_cut);
    division.laid_out.clear();
    division.laid_out.resize(division.parts.size());
  }

  const CurvedRegion& region_;
  const Ground& ground_;
  const RegionDivision settings_;
  DividedRegion result_;
  std::vector<Index> opposite_;
};

}  // namespace

DividedRegion divide_region(const CurvedRegion& region, const Ground& ground, const RegionDivision& settings) {
  return RegionDividing(region, ground, settings).run();
}

}  // namespace qmorph::chart
