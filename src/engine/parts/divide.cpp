// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/parts/divide.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>

#include "engine/parts/cutting_line.hpp"
#include "engine/parts/interface.hpp"
#include "kernel/sort_unique.hpp"
#include "parallel/for_each.hpp"

namespace qmorph {
namespace {

using kernel::Mesh;

/// What is larger than this times the size that parts are to have is cut.
constexpr double kTooLarge = 1.5;
/// A piece of a part that is smaller than this times the size that parts are to have goes to a neighbour.
constexpr double kCrumb = 0.1;

std::array<Vec2, 3> corners_of(const Mesh& mesh, Index f) {
  const Index h = mesh.half_edge(f);
  return {mesh.point(mesh.origin(h)), mesh.point(mesh.target(h)), mesh.point(mesh.origin(mesh.prev(h)))};
}

Vec2 middle_of(const Mesh& mesh, Index f) {
  const auto [a, b, c] = corners_of(mesh, f);
  return (a + b + c) / 3;
}

/// A part that may still be cut.
struct Part {
  std::vector<Index> faces;    ///< ascending
  std::vector<Index> outline;  ///< half-edges of the faces
};

class Dividing {
 public:
  Dividing(Mesh& mesh, std::size_t triangles) : mesh_(mesh), triangles_(double(triangles)) {
    division_.part.assign(mesh.face_slots(), kNone);
    other_.assign(mesh.face_slots(), 0);
  }

  Division run() {
    Part& whole = parts_.emplace_back();
    for (Index f = 0; f < mesh_.face_slots(); ++f)
      if (mesh_.is_live_face(f)) whole.faces.push_back(f), division_.part[f] = 0;
    for (Index h = 0; h < mesh_.half_edge_slots(); ++h)
      if (mesh_.is_live_half_edge(h) && mesh_.face(h) == kNone) whole.outline.push_back(Mesh::twin(h));
    std::vector<Index> waiting{0};
    for (std::size_t i = 0; i < waiting.size(); ++i) {
      const Index part = waiting[i];
      if (double(parts_[part].faces.size()) <= kTooLarge * triangles_ || !cut(part)) continue;
      waiting.push_back(part);
      waiting.push_back(division_.parts - 1);
    }
    if (division_.parts > 1) settle_pieces();
    if (division_.parts > 1) finish_interfaces(mesh_, division_);
    return std::move(division_);
  }

 private:
  /// Cuts a part in two: false if that leaves nothing on one side.
  bool cut(Index part) {
    const auto& [faces, outline] = parts_[part];
    const std::vector<Index> interface = interface_along(choose_line(faces, outline), part, faces);
    Part sides[2];
    for (Index f : faces) sides[int(other_[f])].faces.push_back(f);
    if (sides[0].faces.empty() || sides[1].faces.empty()) return false;
    for (Index f : sides[1].faces) division_.part[f] = division_.parts;
    for (const auto& edges : {outline, interface})
      for (Index h : edges) sides[int(other_[mesh_.face(h)])].outline.push_back(h);
    std::vector<Index> nodes;
    for (Index h : interface) nodes.push_back(mesh_.origin(h));
    sort_unique(nodes);
    straighten_interfaces(mesh_, division_, nodes);
    parts_[part] = std::move(sides[0]);
    parts_.push_back(std::move(sides[1]));
    ++division_.parts;
    return true;
  }

  Line choose_line(const std::vector<Index>& faces, const std::vector<Index>& outline) const {
    constexpr std::size_t kSamples = 4096;
    std::vector<Vec2> samples;
    for (std::size_t i = 0; i < faces.size(); i += 1 + faces.size() / kSamples)
      samples.push_back(middle_of(mesh_, faces[i]));
    std::vector<std::pair<Vec2, Vec2>> segments;
    for (Index h : outline) segments.emplace_back(mesh_.point(mesh_.origin(h)), mesh_.point(mesh_.target(h)));
    const double parts = std::max(2.0, std::round(double(faces.size()) / triangles_));
    return choose_cutting_line(samples, segments, std::floor(parts / 2) / parts);
  }

  /// Sets `other_` of the part's faces: beyond the line, but for teeth. Returns the half-edges between the two sides.
  std::vector<Index> interface_along(const Line& line, Index part, const std::vector<Index>& faces) {
    std::vector<Index> on_line;
    for (Index f : faces) {
      const auto [a, b, c] = corners_of(mesh_, f);
      const auto lies_beyond = [&](const Vec2& p) { return line.distance(p) >= 0; };
      const bool beyond = lies_beyond((a + b + c) / 3);
      other_[f] = beyond;
      if (lies_beyond(a) != beyond || lies_beyond(b) != beyond || lies_beyond(c) != beyond) on_line.push_back(f);
    }
    even_out(part, on_line);  // two faces on different sides: the line passes through one of them, or one has moved
    std::vector<Index> interface;
    for (Index f : on_line)
      for_each_side(f, [&](Index h) {
        if (part_beyond(h) != part || other_[f] == other_[mesh_.face(Mesh::twin(h))]) return;
        interface.push_back(h);
        interface.push_back(Mesh::twin(h));
      });
    sort_unique(interface);
    return interface;
  }

  template <class Visit>
  void for_each_side(Index f, const Visit& visit) const {
    Index h = mesh_.half_edge(f);
    for (int i = 0; i < 3; ++i, h = mesh_.next(h)) visit(h);
  }

  Index part_beyond(Index h) const {
    const Index g = mesh_.face(Mesh::twin(h));
    return g == kNone ? kNone : division_.part[g];
  }

  /// A triangle with two neighbours on the other side goes there: no teeth. Each move shortens the interface.
  /// Appends what has moved to `on_line`.
  void even_out(Index part, std::vector<Index>& on_line) {
    const auto is_tooth = [&](Index f) {
      int others = 0;
      for_each_side(
          f, [&](Index h) { others += part_beyond(h) == part && other_[mesh_.face(Mesh::twin(h))] != other_[f]; });
      return others >= 2;
    };
    std::vector<Index> teeth = on_line;
    for (Index f : on_line)
      for_each_side(f, [&](Index h) {
        if (part_beyond(h) == part) teeth.push_back(mesh_.face(Mesh::twin(h)));
      });
    sort_unique(teeth);
    while (!teeth.empty()) {
      const Index f = teeth.back();
      teeth.pop_back();
      if (!is_tooth(f)) continue;
      other_[f] = !other_[f];
      on_line.push_back(f);
      for_each_side(f, [&](Index h) {
        if (part_beyond(h) == part) teeth.push_back(mesh_.face(Mesh::twin(h)));
      });
    }
  }

  /// A line may cut a part into several pieces: a large one becomes a part of its own, crumbs go to a neighbour.
  void settle_pieces() {
    std::vector<std::vector<std::vector<Index>>> pieces_of(division_.parts);
    std::vector<char> seen(mesh_.face_slots(), 0);
    parallel::for_each_index(division_.parts, [&](std::size_t part) {
      if (has_one_loop(parts_[part])) return pieces_of[part].push_back(std::move(parts_[part].faces));
      for (Index f : parts_[part].faces)
        if (!seen[f]) pieces_of[part].push_back(piece_around(f, seen));
    });
    std::vector<std::vector<Index>> pieces;
    for (auto& some : pieces_of) std::move(some.begin(), some.end(), std::back_inserter(pieces));
    std::sort(pieces.begin(), pieces.end(),
              [](const auto& a, const auto& b) { return a.size() != b.size() ? a.size() > b.size() : a[0] < b[0]; });
    std::vector<char> is_taken(division_.parts, 0);
    for (const auto& piece : pieces) {
      const Index part = division_.part[piece[0]];
      Index becomes = part;
      if (is_taken[part]) becomes = double(piece.size()) < kCrumb * triangles_ ? part_around(piece) : division_.parts++;
      if (becomes < is_taken.size()) is_taken[becomes] = 1;
      if (becomes == part) continue;
      for (Index f : piece) division_.part[f] = becomes;
    }
  }

  /// The outline is one loop, so the part is one piece: each piece has a loop of its own, or more.
  bool has_one_loop(const Part& part) const {
    std::size_t sides = 0;
    Index h = part.outline[0];
    const Index own = division_.part[mesh_.face(h)];
    do {
      ++sides;
      h = mesh_.next(h);
      while (part_beyond(h) == own) h = mesh_.rotate_cw(h);
    } while (h != part.outline[0]);
    return sides == part.outline.size();
  }

  std::vector<Index> piece_around(Index first, std::vector<char>& seen) const {
    std::vector<Index> piece{first};
    seen[first] = 1;
    for (std::size_t i = 0; i < piece.size(); ++i)
      for_each_side(piece[i], [&](Index h) {
        const Index g = mesh_.face(Mesh::twin(h));
        if (g != kNone && !seen[g] && division_.part[g] == division_.part[first]) seen[g] = 1, piece.push_back(g);
      });
    return piece;
  }

  /// The part that lies beyond most sides of a piece.
  Index part_around(const std::vector<Index>& piece) const {
    std::map<Index, int> sides;
    const Index own = division_.part[piece[0]];
    for (Index f : piece)
      for_each_side(f, [&](Index h) {
        const Index part = part_beyond(h);
        if (part != kNone && part != own) ++sides[part];
      });
    const auto most =
        std::max_element(sides.begin(), sides.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    return most == sides.end() ? own : most->first;
  }

  Mesh& mesh_;
  const double triangles_;
  Division division_;
  std::vector<char> other_;  ///< by face: which side of the line
  std::vector<Part> parts_;
};

}  // namespace

Division divide(Mesh& mesh, std::size_t triangles) { return Dividing(mesh, triangles).run(); }

}  // namespace qmorph
