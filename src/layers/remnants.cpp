// SPDX-License-Identifier: GPL-2.0-or-later
#include "layers/remnants.hpp"

#include <algorithm>
#include <map>

#include "layers/forest.hpp"
#include "layers/walls.hpp"

namespace qmorph::layers {
namespace {

/// The cut that begins at side c of a free triangle; nothing if it does not lead to another one, along one column.
std::optional<Cut> cut_from(const Cells& cells, Index c) {
  const Sides& sides = cells.sides();
  Cut cut;
  cut.start = c;
  while (true) {
    if (sides.is_wall(c)) return std::nullopt;
    const Index other = sides.opposite(c), number = cells.owner(other / 3);
    if (number == kNone) {
      cut.end = other;
      if (cut.cells.empty()) return std::nullopt;
      return cut;
    }
    const Cell& cell = cells[number];
    if (other != cell.base && other != cell.top) return std::nullopt;
    cut.cells.push_back(number);
    c = other == cell.base ? cell.top : cell.base;
  }
}

double length_of(const Sides& sides, Index c) { return (sides.point(sides.to(c)) - sides.point(sides.from(c))).norm(); }

/// How many free triangles of a small part lie beyond side c of a free triangle, which is not counted itself.
std::size_t count_beyond(const Cells& cells, Index c) {
  const Sides& sides = cells.sides();
  std::vector<Index> found{c / 3};
  const auto reach = [&](Index side) {
    if (sides.is_wall(side)) return;
    const Index t = sides.opposite(side) / 3;
    if (!cells.is_taken(t) && std::find(found.begin(), found.end(), t) == found.end()) found.push_back(t);
  };
  reach(c);
  for (std::size_t next = 1; next < found.size(); ++next)
    for (Index side = 3 * found[next]; side < 3 * found[next] + 3; ++side) reach(side);
  return found.size() - 1;
}

/// A triangle at the tip of a fan becomes two, which are halves of a straight angle. They should not be a pair, but
/// have one each on both sides.
bool leaves_pairs(const Cells& cells, const Parts& parts, Index start) {
  constexpr std::size_t kFew = 16;
  if (parts.sizes[parts.part_of[start / 3]] > kFew) return true;
  return count_beyond(cells, Sides::next(start)) % 2 == 1 && count_beyond(cells, Sides::previous(start)) % 2 == 1;
}

/// The best cut between each two parts, from the lower to the higher number: of those that leave pairs at their ends
/// the one with the longest end.
using Links = std::map<Edge, Cut>;

Links link_parts(const Cells& cells, const Parts& parts) {
  const Sides& sides = cells.sides();
  Links links;
  for (Index c = 0; c < sides.count(); ++c) {
    if (cells.is_taken(c / 3)) continue;
    const auto cut = cut_from(cells, c);
    if (!cut) continue;
    const Index from = parts.part_of[c / 3], to = parts.part_of[cut->end / 3];
    if (from >= to) continue;
    const auto worth = [&](const Cut& k) {
      return std::pair(leaves_pairs(cells, parts, k.start) && leaves_pairs(cells, parts, k.end),
                       std::max(length_of(sides, k.start), length_of(sides, k.end)));
    };
    const auto [link, is_new] = links.try_emplace({from, to}, *cut);
    if (!is_new && worth(*cut) > worth(link->second)) link->second = *cut;
  }
  return links;
}

/// Parts and the cuts between them: an odd part and the one at the other end are both the opposite after a cut.
Forest join_by_cuts(const Parts& parts, const std::vector<Edge>& ends) {
  std::vector<bool> is_odd(parts.sizes.size());
  std::vector<Index> by_size(parts.sizes.size());
  for (Index i = 0; i < by_size.size(); ++i) by_size[i] = i, is_odd[i] = parts.is_odd(i);
  std::stable_sort(by_size.begin(), by_size.end(), [&](Index a, Index b) { return parts.sizes[a] > parts.sizes[b]; });
  return Forest(std::move(is_odd), ends, by_size);
}

/// Drops cells on the shortest ways between trees, so that the odd ones come together in pairs.
class TreeJoiner {
 public:
  TreeJoiner(Cells& cells, const Parts& parts, const Forest& forest)
      : cells_(cells), tree_(cells.size(), kNone), from_(cells.size(), kNone), distance_(cells.size(), 0) {
    const Sides& sides = cells.sides();
    for (Index c = 0; c < sides.count(); ++c)
      if (!cells.is_taken(c / 3)) reach(c, forest.root(parts.part_of[c / 3]), kNone);
    for (std::size_t next = 0; next < order_.size(); ++next) {
      const Index at = order_[next];
      for_each_side(at, [&](Index c) { reach(c, tree_[at], at); });
    }
  }

  /// \return false if no cell lies between any two of them
  bool join(const std::vector<bool>& must_join) {
    const std::map<Edge, Meeting> meetings = find_meetings();
    std::vector<std::pair<std::size_t, Edge>> by_length;
    for (const auto& [trees, meeting] : meetings) by_length.emplace_back(meeting.length, trees);
    std::sort(by_length.begin(), by_length.end());
    std::vector<Edge> edges;
    for (const auto& [length, trees] : by_length) edges.push_back(trees);
    edges = spanning_edges(must_join.size(), edges);

    std::vector<Index> roots;  // one that is odd, where there is one
    for (const bool is_odd : {true, false})
      for (Index tree = 0; tree < must_join.size(); ++tree)
        if (must_join[tree] == is_odd) roots.push_back(tree);
    const Forest pairs(must_join, edges, roots);
    for (Index e : pairs.used()) {
      const Meeting& meeting = meetings.at(edges[e]);
      for (Index end : {meeting.here, meeting.there})
        for (Index at = end; at != kNone; at = from_[at])
          if (cells_.is_live(at)) cells_.drop(at);
    }
    return !pairs.used().empty();
  }

 private:
  /// The cells in the middle of a way between two trees; one only, or two side by side.
  struct Meeting {
    std::size_t length = std::size_t(-1);
    Index here = kNone, there = kNone;
  };

  /// The shortest ways, by trees, the lower number first.
  std::map<Edge, Meeting> find_meetings() const {
    std::map<Edge, Meeting> best;
    const auto meet = [&](Index one, Index two, const Meeting& meeting) {
      Meeting& known = best[std::minmax(one, two)];
      if (meeting.length < known.length) known = meeting;
    };
    for (const auto& [cell, other] : shared_) meet(tree_[cell], other, {distance_[cell], cell, kNone});
    const Sides& sides = cells_.sides();
    for (Index here : order_)
      for_each_side(here, [&](Index c) {
        const Index there = sides.is_wall(c) ? kNone : cells_.owner(sides.opposite(c) / 3);
        if (there != kNone && tree_[there] != tree_[here])
          meet(tree_[here], tree_[there], {distance_[here] + distance_[there], here, there});
      });
    return best;
  }

  template <class Visit>
  void for_each_side(Index cell, const Visit& visit) const {
    for (Index c : {cells_[cell].base, cells_[cell].right, cells_[cell].top, cells_[cell].left}) visit(c);
  }

  /// From side c of a cell, or of a free triangle, to the cell beyond.
  void reach(Index c, Index tree, Index from) {
    const Sides& sides = cells_.sides();
    if (sides.is_wall(c)) return;
    const Index cell = cells_.owner(sides.opposite(c) / 3);
    if (cell == kNone) return;
    if (tree_[cell] != kNone) {
      if (tree_[cell] != tree && from == kNone) shared_.emplace_back(cell, tree);
      return;
    }
    tree_[cell] = tree;
    from_[cell] = from;
    distance_[cell] = from == kNone ? 1 : distance_[from] + 1;
    order_.push_back(cell);
  }

  Cells& cells_;
  std::vector<Index> tree_, from_;  ///< by cell: the nearest tree, and the cell before it on the way from there
  std::vector<std::size_t> distance_;
  std::vector<Index> order_;
  std::vector<std::pair<Index, Index>> shared_;  ///< a cell at the border of its tree, and of another one
};

/// The odd trees of regions that have more of them than they may.
std::vector<bool> trees_to_join(const Parts& parts, const Forest& forest, const Parts& regions) {
  std::vector<std::size_t> odd(regions.sizes.size(), 0);
  std::vector<Index> region_of(parts.sizes.size(), kNone);
  for (Index t = 0; t < parts.part_of.size(); ++t) {
    const Index part = parts.part_of[t];
    if (part == kNone || region_of[part] != kNone) continue;
    region_of[part] = regions.part_of[t];
    if (forest.root(part) == part && forest.is_odd_tree(part)) ++odd[region_of[part]];
  }
  std::vector<bool> must_join(parts.sizes.size(), false);
  for (Index part = 0; part < parts.sizes.size(); ++part)
    must_join[part] = forest.root(part) == part && forest.is_odd_tree(part) && odd[region_of[part]] > 1;
  return must_join;
}

}  // namespace

Parts all_parts(const Sides& sides) {
  return parts_of(sides, [](Index) { return true; });
}

Parts free_parts(const Cells& cells) {
  return parts_of(cells.sides(), [&](Index t) { return !cells.is_taken(t); });
}

void drop_broken_rows(Cells& cells, const Parts& regions) {
  constexpr double kWhole = 0.8;
  const Sides& sides = cells.sides();
  std::vector<std::size_t> singles(regions.sizes.size(), 0);
  const auto for_each_single = [&](const auto& visit) {
    for (Index i = 0; i < cells.size(); ++i)
      if (cells.is_live(i) && sides.is_wall(cells[i].base) && sides.is_wall(cells[i].top))
        visit(i, regions.part_of[cells[i].triangles[0]]);
  };
  for_each_single([&](Index, Index region) { ++singles[region]; });
  std::vector<bool> is_broken(regions.sizes.size(), false);
  for_each_single([&](Index i, Index region) {
    if (2 * double(singles[region]) >= kWhole * double(regions.sizes[region])) return;
    cells.drop(i);
    is_broken[region] = true;
  });
  // What the row ended in is no row any more.
  for (Index i = 0; i < cells.size(); ++i)
    if (cells.is_live(i) && is_broken[regions.part_of[cells[i].triangles[0]]] && cells.row_length(i, 0, kRow) < kRow)
      cells.drop(i);
}

std::vector<Cut> make_even(Cells& cells, const Parts& regions) {
  while (true) {
    const Parts parts = free_parts(cells);
    const Links links = link_parts(cells, parts);
    std::vector<Edge> ends;
    for (const auto& [trees, cut] : links) ends.push_back(trees);
    const Forest forest = join_by_cuts(parts, ends);
    const std::vector<bool> must_join = trees_to_join(parts, forest, regions);
    const bool is_even = std::find(must_join.begin(), must_join.end(), true) == must_join.end();
    if (!is_even && TreeJoiner(cells, parts, forest).join(must_join)) continue;
    std::vector<Cut> cuts;
    for (Index e : forest.used()) cuts.push_back(links.at(ends[e]));
    return cuts;
  }
}

}  // namespace qmorph::layers
