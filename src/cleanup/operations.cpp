// SPDX-License-Identifier: GPL-2.0-or-later
#include "cleanup/operations.hpp"

#include <algorithm>
#include <array>

#include "topology/edits.hpp"

namespace qmorph::cleanup {
namespace {

using kernel::Mesh;

/// Gain of taking one edge from v. An interior node that is left with two becomes a doublet and vanishes, which
/// takes one edge from each of its neighbours; those are `rest` and `merged`.
int gain_of_losing_edge(const Mesh& mesh, const Score& score, Index v) {
  if (mesh.is_free(v) && mesh.valence(v) == 3) return score.cost(v);
  return score.gain(v, -1);
}

int close_gain(const Mesh& mesh, const Score& score, Index h) {
  const Index a = mesh.origin(h), b = mesh.target(h), c = mesh.target(mesh.next(h)), d = mesh.origin(mesh.prev(h));
  const int merged = int(mesh.valence(a) + mesh.valence(c)) - 2 - score.ideal(c);
  int doublets = 0;
  for (Index v : {b, d}) doublets += mesh.is_free(v) && mesh.valence(v) == 3;
  const int after = merged - doublets;
  return score.cost(a) + score.cost(c) - after * after + gain_of_losing_edge(mesh, score, b) +
         gain_of_losing_edge(mesh, score, d);
}

void add_closes(const Mesh& mesh, const Score& score, Index h, int least, std::vector<Candidate>& out) {
  // Both diagonals of the face; what is free vanishes into the other end.
  for (Index start : std::array<Index, 2>{h, mesh.next(h)}) {
    const Index opposite = mesh.next(mesh.next(start));
    const Index from = mesh.is_free(mesh.origin(start)) ? start : opposite;
    if (!mesh.is_free(mesh.origin(from))) continue;
    const int gain = close_gain(mesh, score, from);
    if (gain >= least) out.push_back({Action::close, from, kNone, gain});
  }
}

void add_turns(const Mesh& mesh, const Score& score, Index h, int least, std::vector<Candidate>& out) {
  const Index t = Mesh::twin(h);
  if (!mesh.is_quad(mesh.face(h)) || !mesh.is_quad(mesh.face(t)) || mesh.face(h) == mesh.face(t)) return;
  const Index a = mesh.origin(h), b = mesh.target(h);
  for (Index v : {a, b})
    if (mesh.valence(v) < 3 || (mesh.is_free(v) && mesh.valence(v) < 4)) return;
  const int base = score.gain(a, -1) + score.gain(b, -1);
  // Hexagon: h: a -> b, then c, d behind in its face; t: b -> a, then e, g in the other.
  const Index c = mesh.target(mesh.next(h)), d = mesh.origin(mesh.prev(h));
  const Index e = mesh.target(mesh.next(t)), g = mesh.origin(mesh.prev(t));
  const int left = base + score.gain(c, 1) + score.gain(e, 1);
  const int right = base + score.gain(d, 1) + score.gain(g, 1);
  if (left >= least) out.push_back({Action::turn_left, h, kNone, left});
  if (right >= least) out.push_back({Action::turn_right, h, kNone, right});
}

void add_opens(const Mesh& mesh, const Score& score, Index v, int least, std::vector<Candidate>& out) {
  const int n = int(mesh.valence(v));
  if (n < 5) return;
  std::vector<Index> spokes;
  for (Index h : mesh.around_inside(v)) spokes.push_back(h);
  for (int i = 0; i < n; ++i)
    for (int between = 1; between <= n - 3; ++between) {
      const int j = (i + between + 1) % n;
      if (mesh.is_boundary(v) && j <= i) continue;                      // the boundary edges, 0 and n - 1, stay at v
      if (!mesh.is_boundary(v) && between + 2 > n - between) continue;  // the mirror image has it
      const int kept = n - between - score.ideal(v), made = between + 2 - 4;
      const int gain = score.cost(v) - kept * kept - made * made + score.gain(mesh.target(spokes[i]), 1) +
                       score.gain(mesh.target(spokes[j]), 1);
      if (gain >= least) out.push_back({Action::open, spokes[i], spokes[j], gain});
    }
}

void add_star_removals(const Mesh& mesh, const Score& score, Index v, int least, std::vector<Candidate>& out) {
  if (!mesh.is_free(v) || mesh.valence(v) != 3) return;
  Index h = mesh.out(v);
  for (int i = 0; i < 3; ++i, h = mesh.rotate_ccw(h)) {
    if (!mesh.is_quad(mesh.face(h))) return;
    const Index lost = mesh.target(h);
    if (mesh.is_free(lost) && mesh.valence(lost) < 4) return;
  }
  for (int i = 0; i < 3; ++i, h = mesh.rotate_ccw(h)) {
    // The diagonal joins a neighbour of v with the corner of the face across from it.
    const Index k = mesh.rotate_ccw(h), l = mesh.rotate_ccw(k);
    const Index across = mesh.target(mesh.next(k));  // between k and l
    const int gain =
        score.cost(v) + score.gain(mesh.target(k), -1) + score.gain(mesh.target(l), -1) + score.gain(across, 1);
    if (gain >= least) out.push_back({Action::remove_star, h, kNone, gain});
  }
}

bool close(Mesh& mesh, Index h, std::vector<Index>& nodes) {
  const Index a = mesh.origin(h), c = mesh.target(mesh.next(h));
  const bool both = mesh.is_free(c);
  const Vec2 middle = 0.5 * (mesh.point(a) + mesh.point(c));
  const Index diagonal = mesh.split_face(h, mesh.next(mesh.next(h)));
  if (!mesh.can_collapse(diagonal)) return false;
  mesh.collapse(diagonal);
  if (both) mesh.set_point(c, middle);
  nodes.push_back(c);
  return true;
}

bool turn(Mesh& mesh, Index h, bool left) {
  const Index c = mesh.next(mesh.next(h)), d = mesh.prev(h);
  const Index t = Mesh::twin(h);
  const Index e = mesh.next(mesh.next(t)), g = mesh.prev(t);
  if (left ? mesh.find(mesh.origin(c), mesh.origin(e)) != kNone : mesh.find(mesh.origin(d), mesh.origin(g)) != kNone)
    return false;
  mesh.join_faces(h);
  mesh.split_face(left ? c : d, left ? e : g);
  return true;
}

bool remove_star(Mesh& mesh, Index h) {
  const Index k = mesh.rotate_ccw(h), l = mesh.rotate_ccw(k);
  const Index near = mesh.target(h), far = mesh.target(mesh.next(k));
  if (mesh.find(near, far) != kNone) return false;
  std::vector<Index> ring, faces;
  for (Index spoke : {h, k, l}) {
    faces.push_back(mesh.face(spoke));
    ring.push_back(mesh.next(spoke));
    ring.push_back(mesh.next(mesh.next(spoke)));
  }
  if (faces[0] == faces[1] || faces[1] == faces[2] || faces[0] == faces[2]) return false;
  mesh.make_face(ring, faces);
  mesh.split_face(ring[0], ring[3]);  // from target(h) to the corner across
  return true;
}

void collect_around(const Mesh& mesh, Index h, std::vector<Index>& nodes) {
  for (Index e : Mesh::halves_of(h))
    if (mesh.face(e) != kNone)
      for (Index v : topology::nodes_of(mesh, mesh.face(e))) nodes.push_back(v);
}

}  // namespace

std::vector<Candidate> candidates_around(const Mesh& mesh, const Score& score, Index v, int least) {
  std::vector<Candidate> found;
  for (Index h : mesh.around(v)) {
    add_turns(mesh, score, h, least, found);
    if (mesh.is_quad(mesh.face(h))) {
      add_closes(mesh, score, h, least, found);
      add_turns(mesh, score, mesh.next(h), least, found);
      add_turns(mesh, score, mesh.next(mesh.next(h)), least, found);
    }
  }
  add_opens(mesh, score, v, least, found);
  add_star_removals(mesh, score, v, least, found);
  std::stable_sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) { return a.gain > b.gain; });
  return found;
}

std::vector<Candidate> best_candidates(const Mesh& mesh, const Score& score, const std::vector<Index>& nodes,
                                       int least_gain, std::size_t most) {
  std::vector<Candidate> candidates;
  for (Index v : nodes) {
    if (mesh.valence(v) > kMostValence) continue;
    for (const Candidate& c : candidates_around(mesh, score, v, least_gain))
      if (std::find(candidates.begin(), candidates.end(), c) == candidates.end()) candidates.push_back(c);
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.gain > b.gain; });
  if (candidates.size() > most) candidates.resize(most);
  return candidates;
}

bool apply(Mesh& mesh, const Candidate& c, std::vector<Index>& nodes) {
  collect_around(mesh, c.h, nodes);
  if (c.k != kNone) collect_around(mesh, c.k, nodes);
  switch (c.action) {
    case Action::close:
      return close(mesh, c.h, nodes);
    case Action::turn_left:
      return turn(mesh, c.h, true);
    case Action::turn_right:
      return turn(mesh, c.h, false);
    case Action::remove_star:
      collect_around(mesh, mesh.rotate_ccw(c.h), nodes);
      return remove_star(mesh, c.h);
    case Action::open: {
      const Vec2& p = mesh.point(mesh.origin(c.h));
      Vec2 centre = Vec2::Zero();
      int spokes = 0;
      for (Index e = mesh.rotate_ccw(c.h); e != c.k; e = mesh.rotate_ccw(e))
        centre += mesh.point(mesh.target(e)), ++spokes;
      constexpr double kShare = 0.25;
      nodes.push_back(mesh.open_quad(c.h, c.k, p + kShare * (centre / spokes - p)));
      return true;
    }
  }
  return false;
}

}  // namespace qmorph::cleanup
