// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A disc of quads that is to be replaced, grown from one irregular node to others.

#include <vector>

#include "kernel/mark_set.hpp"
#include "kernel/mesh.hpp"

namespace qmorph::cleanup {

class Cavity {
 public:
  explicit Cavity(const kernel::Mesh& mesh) : mesh_(mesh) {}

  /// The quads around v. False if they are no disc of quads whose inner nodes are free.
  bool start(Index v);
  /// These faces. False as above.
  bool start_with(const std::vector<Index>& faces);
  /// All faces of the mesh. False as above.
  bool start_with_all();
  /// Adds the quads around these nodes, and those without which the outline would be concave. False, with the disc as
  /// it was, if that is no disc or has more than `most` quads.
  bool add_nodes(const std::vector<Index>& nodes, std::size_t most);
  /// All quads around v are in the disc.
  bool is_inside(Index v) const;
  /// One of them is.
  bool touches(Index v) const;

  const std::vector<Index>& faces() const { return faces_; }
  /// Half-edges round the disc, the disc on their left.
  const std::vector<Index>& outline() const { return outline_; }
  const std::vector<Index>& inner_nodes() const { return inner_; }
  /// Edges at origin(outline()[i]) that are not inside the disc; the two of the outline count.
  const std::vector<int>& outer_edges() const { return outer_; }

 private:
  bool contains(Index f) const { return f != kNone && inside_.contains(f); }
  template <class Test>
  bool any_around(Index v, const Test& test) const;
  bool add(Index f);
  bool add_around(Index v);
  bool make_convex(std::size_t most = std::size_t(-1));
  bool trace();
  bool trace_outline();
  void count_outer_edges();
  bool take_inner_nodes();
  bool is_disc() const;
  void begin();
  /// Calls visit(h) for the half-edges of the faces that were added since the outline was found.
  template <class Visit>
  void for_new_sides(const Visit& visit) const;

  const kernel::Mesh& mesh_;
  std::vector<Index> faces_, outline_, inner_;
  std::vector<Index> old_outline_;                ///< the one before
  std::vector<Index> kept_outline_, kept_inner_;  ///< from before nodes were added
  std::vector<int> kept_outer_;
  std::size_t traced_ = 0;  ///< faces when the outline was found
  std::vector<int> outer_;
  kernel::MarkSet inside_;      ///< `faces_`
  kernel::MarkSet taken_;       ///< nodes of the outline, and those found inside of it
  std::vector<Index> leaving_;  ///< by node: the half-edge of the outline that starts there
};

}  // namespace qmorph::cleanup
