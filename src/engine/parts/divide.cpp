#include "engine/parts/divide.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/parts/cutting_line.hpp"
#include "engine/parts/interface.hpp"

namespace qmorph {
namespace {

using kernel::Mesh;

/// What is larger than this times the size that parts are to have is cut.
constexpr double kTooLarge = 1.5;
/// A piece of a part that is smaller than this times the size that parts are to have goes to a neighbour.
constexpr double kCrumb = 0.1;

Vec2 middle_of(const Mesh& mesh, Index f) {
  const Index h = mesh.half_edge(f);
  return (mesh.point(mesh.origin(h)) + mesh.point(mesh.target(h)) + mesh.point(mesh.origin(mesh.prev(h)))) / 3;
}

class Dividing {
 public:
  Dividing(Mesh& mesh, std::size_t triangles) : mesh_(mesh), triangles_(double(triangles)) {
    division_.part.assign(mesh.face_slots(), kNone);
    other_.assign(mesh.face_slots(), 0);
  }

  Division run() {
    std::vector<Index> all;
    for (Index f = 0; f < mesh_.face_slots(); ++f)
      if (mesh_.is_live_face(f)) all.push_back(f), division_.part[f] = 0;
    waiting_.emplace_back(0, std::move(all));
    for (std::size_t i = 0; i < waiting_.size(); ++i) {
      const auto [part, faces] = std::move(waiting_[i]);
      if (double(faces.size()) > kTooLarge * triangles_) cut(part, faces);
    }
    if (division_.parts > 1) settle_pieces();
    if (division_.parts > 1) finish_interfaces(mesh_, division_);
    return std::move(division_);
  }

 private:
  void cut(Index part, const std::vector<Index>& faces) {
    const Line line = choose_line(part, faces);
    for (Index f : faces) other_[f] = line.distance(middle_of(mesh_, f)) >= 0;
    even_out(part, faces);
    std::vector<Index> sides[2];
    for (Index f : faces) sides[int(other_[f])].push_back(f);
    if (sides[0].empty() || sides[1].empty()) return;
    for (Index f : sides[1]) division_.part[f] = division_.parts;
    straighten_interfaces(mesh_, division_, nodes_between(faces));
    waiting_.emplace_back(part, std::move(sides[0]));
    waiting_.emplace_back(division_.parts++, std::move(sides[1]));
  }

  Line choose_line(Index part, const std::vector<Index>& faces) const {
    constexpr std::size_t kSamples = 4096;
    std::vector<Vec2> samples;
    for (std::size_t i = 0; i < faces.size(); i += 1 + faces.size() / kSamples)
      samples.push_back(middle_of(mesh_, faces[i]));
    std::vector<std::pair<Vec2, Vec2>> outline;
    for (Index f : faces)
      for_each_side(f, [&](Index h) {
        if (part_beyond(h) != part) outline.emplace_back(mesh_.point(mesh_.origin(h)), mesh_.point(mesh_.target(h)));
      });
    const double parts = std::max(2.0, std::round(double(faces.size()) / triangles_));
    return choose_cutting_line(samples, outline, std::floor(parts / 2) / parts);
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
  void even_out(Index part, const std::vector<Index>& faces) {
    const auto is_tooth = [&](Index f) {
      int others = 0;
      for_each_side(
          f, [&](Index h) { others += part_beyond(h) == part && other_[mesh_.face(Mesh::twin(h))] != other_[f]; });
      return others >= 2;
    };
    std::vector<Index> teeth;
    for (Index f : faces)
      if (is_tooth(f)) teeth.push_back(f);
    while (!teeth.empty()) {
      const Index f = teeth.back();
      teeth.pop_back();
      if (!is_tooth(f)) continue;
      other_[f] = !other_[f];
      for_each_side(f, [&](Index h) {
        if (part_beyond(h) == part) teeth.push_back(mesh_.face(Mesh::twin(h)));
      });
    }
  }

  /// A line may cut a part into several pieces: a large one becomes a part of its own, crumbs go to a neighbour.
  void settle_pieces() {
    std::vector<std::vector<Index>> pieces;
    std::vector<char> seen(mesh_.face_slots(), 0);
    for (Index f = 0; f < mesh_.face_slots(); ++f)
      if (mesh_.is_live_face(f) && !seen[f]) pieces.push_back(piece_around(f, seen));
    std::stable_sort(pieces.begin(), pieces.end(), [](const auto& a, const auto& b) { return a.size() > b.size(); });
    std::vector<char> is_taken(division_.parts, 0);
    for (const auto& piece : pieces) {
      const Index part = division_.part[piece[0]];
      Index becomes = part;
      if (is_taken[part]) becomes = double(piece.size()) < kCrumb * triangles_ ? part_around(piece) : division_.parts++;
      if (becomes < is_taken.size()) is_taken[becomes] = 1;
      for (Index f : piece) division_.part[f] = becomes;
    }
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

  /// Nodes of the interfaces among these faces.
  std::vector<Index> nodes_between(const std::vector<Index>& faces) const {
    std::vector<Index> nodes;
    for (Index f : faces)
      for_each_side(f, [&](Index h) {
        const Index g = mesh_.face(Mesh::twin(h));
        if (division_.is_interface(mesh_, h) && other_[f] != other_[g]) nodes.push_back(mesh_.origin(h));
      });
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
  }

  Mesh& mesh_;
  const double triangles_;
  Division division_;
  std::vector<char> other_;                                    ///< by face: which side of the line
  std::vector<std::pair<Index, std::vector<Index>>> waiting_;  ///< parts that may be too large
};

}  // namespace

Division divide(Mesh& mesh, std::size_t triangles) { return Dividing(mesh, triangles).run(); }

}  // namespace qmorph
