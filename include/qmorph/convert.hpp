// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The entry point of the engine.

#include <optional>
#include <vector>

#include "qmorph/error.hpp"
#include "qmorph/export.hpp"
#include "qmorph/options.hpp"
#include "qmorph/patch.hpp"
#include "qmorph/report.hpp"

namespace qmorph {

/// A surface in quads, and what was done for it.
struct Conversion {
  QuadMesh mesh;
  ConversionReport report;
};

/// Turns the triangles of a surface, planar or curved, into quads (Q-Morph, Owen et al. 1999).
///
/// Guarantees, for every region (triangles joined through edges that are no constraints): every boundary edge and
/// constraint edge of the input is an edge of the result, no fixed node moves, the orientation is the input's,
/// every corner of every element is strictly convex, and no triangle is left where the number of
/// boundary sides is even, exactly one where it is odd. The result depends on the arguments alone.
///
/// On a curved surface all nodes of the result lie on the triangles of the input, and corners are convex by their
/// normals, but where the triangles themselves are folded. Edges that are sharper than `Options::crease_angle` stay,
/// whole or with a node in their middle, and so do the tips of cones. Edges of more than two triangles stay as
/// constraints do.
///
/// \throws SurfaceError if the surface is not oriented consistently, overlaps itself in a plane, has a NaN coordinate,
///         no area or an element that uses a node twice, or cannot be converted without a bad element. It says where.
/// \throws Cancelled if `Options::progress` says so; whatever it or `Options::observer` throws
/// Cost: linear in the number of triangles.
QMORPH_API Conversion convert(const Patch& patch, const Options& options = {});

/// Makes a better quad mesh of one that is there already, by whoever made it: triangles and quads in any share, both
/// free to change. Triangles are paired and passed to one another as far as parity lets, then the stages of convert()
/// after the front follow. `ConversionReport::front_quads` stays 0 but for regions where nothing but the front found
/// valid or good elements.
///
/// Quads that are not convex or turned over are untangled by moving their nodes, else cut into triangles that take
/// part. On a curved surface their nodes go to the middle of their neighbours first, since there is no other surface
/// than theirs; folds that only bad elements of the input make excuse nothing in the result. Guarantees as convert()
/// does, for every region of triangles and quads; `Patch::quads` are not kept. No region gets a smaller least or mean
/// scaled Jacobian than it had, nor more quads under 0.2, but where its triangles could not go otherwise:
/// `ConversionReport::worse_regions`.
///
/// \throws SurfaceError as convert() does, and where an element that is turned over cannot be turned back by moving
/// nodes.
/// Cost: linear in the number of elements.
QMORPH_API Conversion improve(const Patch& patch, const Options& options = {});

/// What became of one surface of several: a conversion, or an error.
struct Outcome {
  std::optional<Conversion> conversion;
  std::optional<SurfaceError> error;
  double seconds = 0;  ///< of this surface; others may have been worked on meanwhile
};

/// convert() or improve() of several surfaces side by side, on `Options::threads` threads. Outcomes are in the order of
/// the patches. Throws nothing but what convert() throws besides SurfaceError.
QMORPH_API std::vector<Outcome> convert_all(const std::vector<const Patch*>& patches, const Options& options = {});
QMORPH_API std::vector<Outcome> improve_all(const std::vector<const Patch*>& patches, const Options& options = {});

}  // namespace qmorph
