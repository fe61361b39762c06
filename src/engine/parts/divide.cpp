#include "engine/parts/divide.hpp"

#include <algorithm>
#include <cmath>

#include "engine/parts/cutting_line.hpp"
#include "engine/parts/interface.hpp"

namespace qmorph {
namespace {

using kernel::Mesh;

/// What is larger than this times the size that parts are to have is cut.
constexpr double kTooLarge = 1.5;
/// A smaller piece of a part goes to the other side.
constexpr double kSmallShare = 0.1;

Vec2 middle_of(const Mesh& mesh, Index f) {
  const Index h = mesh.half_edge(f);
  return (mesh.point(mesh.origin(h)) + mesh.point(mesh.target(h)) + mesh.point(mesh.origin(mesh.prev(h)))) / 3;
}

class Dividing {
 public:
  Dividing(Mesh& mesh, std::size_t triangles) : mesh_(mesh), triangles_(double(triangles)) {
    division_.part.assign(mesh.face_slots(), kNone);
    other_.assign(mesh.face_slots(), 0);
    piece_.assign(mesh.face_slots(), kNone);
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
    if (division_.parts > 1) finish_interfaces(mesh_, division_);
    return std::move(division_);
  }

 private:
  void cut(Index part, const std::vector<Index>& faces) {
    const Line line = choose_line(part, faces);
    for (Index f : faces) other_[f] = line.distance(middle_of(mesh_, f)) >= 0;
    even_out(part, faces);
    auto pieces = pieces_of(part, faces);
    bool any_small = false;
    for (const auto& piece : pieces)
      if (double(piece.size()) < kSmallShare * double(faces.size())) {
        any_small = true;
        for (Index f : piece) other_[f] = !other_[f];
      }
    if (any_small) pieces = pieces_of(part, faces);
    if (pieces.size() < 2) return;
    for (std::size_t i = 1; i < pieces.size(); ++i) {
      for (Index f : pieces[i]) division_.part[f] = division_.parts;
      waiting_.emplace_back(division_.parts++, std::move(pieces[i]));
    }
    waiting_.emplace_back(part, std::move(pieces[0]));
    straighten_interfaces(mesh_, division_, nodes_between(faces));
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

  /// What hangs together on either side, each in the order of the faces.
  std::vector<std::vector<Index>> pieces_of(Index part, const std::vector<Index>& faces) {
    for (Index f : faces) piece_[f] = kNone;
    Index pieces = 0;
    std::vector<Index> open;
    for (Index first : faces) {
      if (piece_[first] != kNone) continue;
      open.assign(1, first);
      piece_[first] = pieces;
      while (!open.empty()) {
        const Index f = open.back();
        open.pop_back();
        for_each_side(f, [&](Index h) {
          if (part_beyond(h) != part) return;
          const Index g = mesh_.face(Mesh::twin(h));
          if (piece_[g] == kNone && other_[g] == other_[f]) piece_[g] = pieces, open.push_back(g);
        });
      }
      ++pieces;
    }
    std::vector<std::vector<Index>> result(pieces);
    for (Index f : faces) result[piece_[f]].push_back(f);
    return result;
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
  std::vector<Index> piece_;                                   ///< by face, of pieces_of()
  std::vector<std::pair<Index, std::vector<Index>>> waiting_;  ///< parts that may be too large
};

}  // namespace

Division divide(Mesh& mesh, std::size_t triangles) { return Dividing(mesh, triangles).run(); }

}  // namespace qmorph
