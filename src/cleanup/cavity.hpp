// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A disc of quads that is to be replaced, grown from one irregular node.

#include <cstdint>
#include <vector>

#include "kernel/mesh.hpp"

namespace qmorph::cleanup {

class Cavity {
 public:
  explicit Cavity(const kernel::Mesh& mesh) : mesh_(mesh) {}

  /// The quads around v. False if they are no disc of quads whose inner nodes are free.
  bool start(Index v);
  /// All faces of the mesh. False as above.
  bool start_with_all();
  /// Adds the quads around irregular nodes of the outline or, if there are none, around all its nodes; then those
  /// without which the outline would be concave. False if that is no such disc, or has more than `most` quads.
  bool grow(std::size_t most);

  const std::vector<Index>& faces() const { return faces_; }
  /// Half-edges round the disc, the disc on their left.
  const std::vector<Index>& outline() const { return outline_; }
  const std::vector<Index>& inner_nodes() const { return inner_; }
  /// Edges at origin(outline()[i]) that are not inside the disc; the two of the outline count.
  const std::vector<int>& outer_edges() const { return outer_; }

 private:
  bool contains(Index f) const { return f != kNone && face_mark_[f] == round_; }
  bool add(Index f);
  bool add_around(Index v);
  bool make_convex();
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
  std::vector<Index> old_outline_;  ///< the one before
  std::size_t traced_ = 0;          ///< faces when the outline was found
  std::vector<int> outer_;
  std::vector<std::uint32_t> face_mark_, node_mark_;
  std::vector<Index> leaving_;  ///< by node: the half-edge of the outline that starts there
  std::uint32_t round_ = 0;     ///< of face marks: one a cavity
  std::uint32_t trace_ = 0;     ///< of node marks: one each time that the outline is found
};

}  // namespace qmorph::cleanup
