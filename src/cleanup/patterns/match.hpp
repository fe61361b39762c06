// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Finds the cases of the tables around a node.

#include <string>
#include <vector>

#include "cleanup/patterns/cases.hpp"
#include "cleanup/patterns/composition.hpp"
#include "kernel/mesh.hpp"

namespace qmorph::cleanup {

/// Valences by the glossary's rule: on the boundary two more than the edges up to 135 degrees, one more up to 225.
class GlossaryValence {
 public:
  explicit GlossaryValence(const kernel::Mesh& mesh) : mesh_(mesh) {}
  int operator()(Index v) const;

 private:
  const kernel::Mesh& mesh_;
  mutable std::vector<signed char> extra_;  ///< of boundary nodes; -1: not known yet. Boundaries do not move.
};

/// A case with its patterns read.
struct Pattern {
  struct Entry {
    int least, most;
    bool is_vertex;
    signed char boundary;  ///< 1: on it, 0: not on it, -1: either
  };
  explicit Pattern(const Case& c);  ///< \throws std::logic_error if the patterns do not fit each other

  const Case* source;
  int centre;
  signed char centre_boundary;
  bool has_vertices;
  std::vector<Entry> ring;
};

/// The nodes around a node and their valences, counter-clockwise or, `mirrored`, clockwise; `darts` are the places
/// where a composition that begins at ring[2 * i] starts.
struct Ring {
  Index centre;
  int valence;
  bool is_boundary, mirrored;
  std::vector<Index> nodes;
  std::vector<int> valences;
  std::vector<Dart> darts;
};

/// False where not only quads meet. O(valence).
bool read_ring(const kernel::Mesh& mesh, const GlossaryValence& valence, Index centre, Ring& ring);
/// The same seen in a mirror. Precondition: not mirrored yet.
Ring mirrored(const kernel::Mesh& mesh, const Ring& ring);

/// Where `pattern` fits the ring, as an index into ring.darts, the first from `from` on; or -1.
int find_match(const kernel::Mesh& mesh, const Pattern& pattern, const Ring& ring, int from = 0);

}  // namespace qmorph::cleanup
