// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Numbers of nodes, half-edges and faces, which are not mixed up: `mesh.is_quad(mesh.origin(h))` does not compile.

#include "qmorph/index.hpp"

namespace qmorph::kernel {

/// The number of one kind of thing. It may be used as a plain Index, as a subscript or in a list of numbers, but an
/// Index becomes an Id only where somebody writes so.
template <class Kind>
class Id {
 public:
  constexpr Id() = default;
  explicit constexpr Id(Index index) : index_(index) {}
  constexpr operator Index() const { return index_; }

 private:
  Index index_ = kNone;
};

/// What functions take: such an Id, or a plain Index, whose kind nobody checks; never an Id of another kind.
template <class Kind>
class AnyId {
 public:
  constexpr AnyId(Index index) : index_(index) {}
  constexpr AnyId(Id<Kind> id) : index_(id) {}
  template <class Other>
  AnyId(Id<Other>) = delete;
  template <class Other>
  AnyId(AnyId<Other>) = delete;
  constexpr operator Index() const { return index_; }

 private:
  Index index_;
};

using NodeId = Id<struct NodeKind>;
using HalfEdgeId = Id<struct HalfEdgeKind>;
using FaceId = Id<struct FaceKind>;
using AnyNode = AnyId<struct NodeKind>;
using AnyHalfEdge = AnyId<struct HalfEdgeKind>;
using AnyFace = AnyId<struct FaceKind>;

}  // namespace qmorph::kernel
