// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Parity of front loops in O(1).
///
/// A quad mesh can be two-coloured: the ends of every edge have different colours. Colour the nodes of every
/// front loop alternately; each quad replaces a path of k front edges by one of 4 - k, so the colours
/// never have to be changed. A new edge between two front nodes of one loop cuts it into two even loops exactly if its
/// ends have different colours. (Thesis and paper count the edges of the loop instead.)
///
/// Loops that have not met yet (outer boundary, holes) are separate systems: their relative colouring is
/// free until a first edge joins them. A loop with an odd number of edges has one edge whose ends have the same
/// colour; when two odd loops join, the merged loop is even and is coloured anew.

#include "front/front.hpp"

namespace qmorph::front {

class LoopColours {
 public:
  LoopColours(const Mesh& mesh, const Front& front) : mesh_(mesh), front_(front) {}

  /// Colours the loop of front edge h as a system of its own. O(loop).
  void colour_loop(Index h);
  bool is_coloured(Index v) const { return labels_[v] != 0; }
  /// An edge between the front nodes a and b leaves no odd loop behind, as far as is known.
  bool may_join(Index a, Index b) const;
  /// v gets the colour that the neighbour of u must have. Overwrites what a dead node left.
  void colour_opposite(Index v, Index u);
  void colour_same(Index v, Index u);
  void forget(Index v) { labels_.set(v, 0); }
  /// To be called after an edge between two front nodes has become part of the front; `front_edge` is an
  /// edge of the loop that resulted.
  void join(Index a, Index b, Index front_edge);
  LoggedColumn<unsigned>& labels() { return labels_; }

 private:
  struct Root {
    unsigned system;
    unsigned colour;
  };
  struct System {
    unsigned parent;
    unsigned flip;  ///< colours relative to the parent's
    bool odd;
  };
  Root root(Index v) const;
  void set_label(Index v, unsigned system, unsigned colour);

  const Mesh& mesh_;
  const Front& front_;
  LoggedColumn<unsigned> labels_;  ///< 0: none, else 1 + 2 * system + colour
  std::vector<System> systems_;
};

}  // namespace qmorph::front
