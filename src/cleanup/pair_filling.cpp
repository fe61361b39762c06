// SPDX-License-Identifier: GPL-2.0-or-later
#include "cleanup/pair_filling.hpp"

#include <cmath>
#include <utility>

namespace qmorph::cleanup {
namespace {

/// The corner that is cut off comes first. Sides run from a corner to the next.
struct Corners {
  std::array<int, 4> place, side;

  Corners(const std::array<int, 4>& places, int n) : place(places) {
    for (int i = 0; i < 4; ++i) side[i] = ((place[(i + 1) % 4] - place[i]) % n + n) % n;
    // The node of three edges is on the side of the longer ones.
    if (side[0] - side[2] < side[1] - side[3]) {
      std::swap(place[0], place[2]), std::swap(place[1], place[3]);
      std::swap(side[0], side[2]), std::swap(side[1], side[3]);
    }
  }

  bool are_those_of_a_grid() const { return side[0] == side[2] && side[1] == side[3]; }
  double width() const { return 0.5 * (side[0] + side[2]); }
  double height() const { return 0.5 * (side[1] + side[3]); }
};

/// Where the node of three edges is: so many edges from the side before the corner that is cut off, and from the side
/// after it. `to_cut` edges beyond it runs the cut.
struct Place {
  int across, up, to_cut;
};

/// Edges from the node of five to the sides of its pentagon: the rest of the first side, the second, the third, the
/// rest of the fourth, the cut.
std::array<int, 5> pentagon_sides(const Corners& corners, const Place& place) {
  const auto& side = corners.side;
  return {side[0] - place.across - place.to_cut, side[1], side[2], side[3] - place.up - place.to_cut,
          place.across + place.up};
}

/// Nothing if one would have no length, but for the one to the cut, or less.
std::optional<std::array<int, 5>> pentagon_spokes(const std::array<int, 5>& side) {
  std::array<int, 5> spokes{};
  for (int i = 0; i < 5; ++i) {
    const int twice = side[i] + side[(i + 1) % 5] - side[(i + 2) % 5] - side[(i + 3) % 5] + side[(i + 4) % 5];
    if (twice < (i == 4 ? 0 : 2)) return {};
    spokes[i] = twice / 2;
  }
  return spokes;
}

int quads_between(const Place& place, const std::array<int, 5>& spokes) {
  int count = place.across * place.up + (place.across + place.up) * place.to_cut;
  for (int i = 0; i < 5; ++i) count += spokes[i] * spokes[(i + 1) % 5];
  return count;
}

PairFilling filling_at(const Corners& corners, const Place& place, const std::array<int, 5>& spokes) {
  PairFilling filling;
  filling.corner = corners.place[0];
  filling.ahead = place.to_cut + place.across;
  filling.back = place.to_cut + place.up;
  filling.triangle.corners = 3;
  filling.triangle.corner = {0, filling.back, filling.back + filling.ahead};
  filling.triangle.spokes = {place.across, place.up, place.to_cut};
  filling.pentagon.corners = 5;
  const std::array<int, 5> side = pentagon_sides(corners, place);
  for (int i = 0; i < 4; ++i) filling.pentagon.corner[i + 1] = filling.pentagon.corner[i] + side[i];
  filling.pentagon.spokes = spokes;
  return filling;
}

/// Places from the first to before the end, in both directions.
struct Places {
  int first_across, end_across, first_up, end_up, to_cut;

  bool is_empty() const { return first_across >= end_across || first_up >= end_up; }
};

/// Whether the fillings at some places have less than `fewest` quads all, or all more than `most`: their number is
/// linear in both directions, so that those in the corners tell.
bool are_out_of(const Corners& corners, const Places& places, double fewest, double most) {
  bool are_few = true, are_many = true;
  for (int across : {places.first_across, places.end_across - 1})
    for (int up : {places.first_up, places.end_up - 1}) {
      const Place place{across, up, places.to_cut};
      const auto spokes = pentagon_spokes(pentagon_sides(corners, place));
      if (!spokes) return false;
      const double count = quads_between(place, *spokes);
      are_few = are_few && count < fewest, are_many = are_many && count > most;
    }
  return are_few || are_many;
}

/// The point of the outline's inside that is so far, in shares of the sides, from the first corner.
Vec2 point_at(const Corners& corners, const std::vector<Vec2>& outline, double u, double v) {
  const auto at = [&](int i) { return outline[corners.place[i]]; };
  return (1 - v) * ((1 - u) * at(0) + u * at(1)) + v * ((1 - u) * at(3) + u * at(2));
}

Vec2 middle_of_pair(const Corners& corners, const std::vector<Vec2>& outline, const Place& place,
                    const std::array<int, 5>& spokes) {
  const double u = 0.5 * (1 + (place.across - spokes[1]) / corners.width());
  const double v = 0.5 * (1 + (place.up - spokes[2]) / corners.height());
  return point_at(corners, outline, u, v);
}

}  // namespace

std::optional<PairChoice> pair_filling_between(const std::array<int, 4>& corner_places, const PairWish& wish) {
  const Corners corners(corner_places, int(wish.outline.size()));
  const auto& side = corners.side;
  if (corners.are_those_of_a_grid()) return {};
  // From the one node to the other it is as far as the sides differ: these many edges through the cut, and so many
  // along it.
  const int through = (side[0] - side[2] - side[1] + side[3]) / 2, along = (side[0] - side[2] + side[1] - side[3]) / 2;
  const int to_cut = (through + 1) / 2;
  const double diagonals =
      0.5 * ((point_at(corners, wish.outline, 1, 1) - point_at(corners, wish.outline, 0, 0)).squaredNorm() +
             (point_at(corners, wish.outline, 1, 0) - point_at(corners, wish.outline, 0, 1)).squaredNorm());
  // Beyond the ends the second or the third spoke of the pentagon would have no length.
  const Places places{std::max(1, 1 + along), std::min(side[0] - to_cut, (side[0] + side[1] + side[2] - side[3]) / 2),
                      std::max(1, 1 - along), std::min(side[3] - to_cut, (side[1] + side[2] + side[3] - side[0]) / 2),
                      to_cut};
  constexpr double kRounding = 1e-9;
  if (places.is_empty() || are_out_of(corners, places, (1 - kRounding) * wish.size.fewest * wish.quads_wanted,
                                      (1 + kRounding) * wish.size.most * wish.quads_wanted))
    return {};
  std::optional<PairChoice> best;
  for (int up = places.first_up; up < places.end_up; ++up)
    for (int across = places.first_across; across < places.end_across; ++across) {
      const Place place{across, up, to_cut};
      const auto spokes = pentagon_spokes(pentagon_sides(corners, place));
      if (!spokes) continue;
      const double share = quads_between(place, *spokes) / wish.quads_wanted;
      if (share < wish.size.fewest || share > wish.size.most) continue;
      const Vec2 middle = middle_of_pair(corners, wish.outline, place, *spokes);
      const double off_size = std::log(share);
      const double misfit = (middle - wish.place).squaredNorm() / diagonals + off_size * off_size;
      if (best && misfit >= best->misfit) continue;
      best = {filling_at(corners, place, *spokes), misfit};
      best->filling.bend = middle;
    }
  return best;
}

}  // namespace qmorph::cleanup
