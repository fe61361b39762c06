// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The entry point for programs that already run the Gmsh API: `qmorph::gmsh::recombine()` in the place of
/// `gmsh::model::mesh::recombine()`. Mentions no Gmsh type; link `qmorph::gmsh`.
///
/// `qmorph::gmsh` is Gmsh's own namespace by another name, and our functions can be seen from there. With a namespace
/// of our own called `gmsh`, no program that says `using namespace qmorph` could write `gmsh::` any more.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "qmorph/certificate.hpp"
#include "qmorph/error.hpp"
#include "qmorph/export.hpp"
#include "qmorph/fidelity.hpp"
#include "qmorph/options.hpp"
#include "qmorph/patch.hpp"
#include "qmorph/quality.hpp"
#include "qmorph/report.hpp"

namespace qmorph {

/// What became of one surface.
enum class SurfaceOutcome {
  converted,      ///< its triangles are quads now
  already_quads,  ///< it had no triangle and is as it was
  left,           ///< it could not be converted and is as it was; `reason` says why
};

/// Where the new nodes of a curved surface lie, if it has a geometry or its triangles are curved themselves; nodes
/// between corners count, too. Other surfaces have nothing but their triangles.
struct OnGeometry {
  std::size_t nodes = 0;  ///< that are new or have moved, on it
  /// That stay on the triangles: an element would be spoiled, or there is no way to the geometry.
  std::size_t left = 0;
  std::size_t moved_sides =
      0;  ///< sides of higher-order elements that are bent less, or not at all, since an element would be folded

  std::size_t all() const { return nodes + left; }
  bool any() const { return all() + moved_sides > 0; }
  void add(const OnGeometry& other) { nodes += other.nodes, left += other.left, moved_sides += other.moved_sides; }
};

/// One surface, before and after.
struct SurfaceReport {
  int tag = 0;
  std::string name;  ///< of its first physical group, or empty
  SurfaceOutcome outcome = SurfaceOutcome::left;
  /// Of left: what is wrong, where, and what to do. Of converted: where curved edges of the input turn an element over,
  /// as they did before; or empty.
  std::string reason;
  std::optional<ErrorDetails> error;  ///< of left: the same for programs
  std::vector<std::string> warnings;  ///< of a surface that was converted all the same
  std::size_t triangles_in = 0, quads_in = 0;
  std::size_t triangles_out = 0, quads_out = 0;
  Quality quality;              ///< of what came out; all defaults for left
  Fidelity fidelity;            ///< of a curved surface that was converted, or of one measured against another
  std::vector<PoorQuad> poor;   ///< why those of its quads that are poor are so; rows count through the surface's parts
  ConversionReport conversion;  ///< of converted: what was done
  OnGeometry on_geometry;
  int image_of = 0;  ///< the surface whose quads it has, if periodic with or extruded from one; else 0
  double seconds = 0;
};

/// The whole model.
struct QMORPH_API ModelReport {
  std::vector<SurfaceReport> surfaces;  ///< by tag; surfaces without an element are not listed
  std::vector<std::string> warnings;
  Quality total;      ///< of the converted and the all-quad surfaces together
  Fidelity fidelity;  ///< of those surfaces that have one together
  OnGeometry on_geometry;
  double read_seconds = 0, convert_seconds = 0, check_seconds = 0, replace_seconds = 0;

  std::size_t count(SurfaceOutcome outcome) const;
  /// Poor quads by what makes them so.
  std::array<std::size_t, kPoorReasons> count_poor() const;
};

/// An edge of the mesh that got a node in its middle.
struct SplitEdge {
  int curve = 0;              ///< 0 if it lies on none
  std::vector<int> surfaces;  ///< one, or two that share it
  Eigen::Vector3d where = Eigen::Vector3d::Zero();
};

/// What `make_even()` did.
struct EvenReport {
  std::size_t odd_regions = 0;    ///< with an odd number of sides, before
  std::vector<SplitEdge> splits;  ///< the fewest that do, on the longest edges
  std::vector<int> odd_surfaces;  ///< where a region stays odd, since no edge that may be split leads there; sorted
};

/// What is done to the model of the running Gmsh session: also to be found as `qmorph::gmsh`.
/// \pre Gmsh is initialised, and called from this thread only. Gmsh's logger is not running.
namespace session {

/// Turns the triangles of surfaces of the current Gmsh model into quads, in place.
///
/// Line elements, point elements, curve nodes, physical groups, entities and all other surfaces stay as they are;
/// new nodes and elements get tags that nothing else has. A surface that cannot be converted is left as it
/// was and reported as left.
/// \param surfaces tags of the surfaces to convert; all if empty. A tag that the model does not have is a UsageError.
/// \throws UsageError, InputError if the mesh of the model contradicts itself, Cancelled, what `Options::progress` and
///         `Options::observer` throw; the mesh is unchanged then. (Nodes that a file gives to entities which do not use
///         them may belong to others already, which Gmsh calls reclassification.)
/// Cost: linear in the size of the model.
QMORPH_API ModelReport recombine(const Options& options = {}, const std::vector<int>& surfaces = {});

/// The same for surfaces that consist of quads already, or of quads and triangles, as Gmsh's own recombination leaves
/// them: all their elements may change, and what comes out has better quads (see `improve()` of qmorph/convert.hpp).
/// Surfaces come out as converted or left.
QMORPH_API ModelReport improve_quads(const Options& options = {}, const std::vector<int>& surfaces = {});

/// Figures of surfaces as they are; nothing changes. Surfaces come out as already_quads, whatever they consist of,
/// those that have no figures (not a manifold, no orientation) with a reason.
/// \param before surfaces by tag, as read_surfaces() gives them: where one of the same tag is given, the report has its
///        `fidelity` to that, flat or curved
QMORPH_API ModelReport measure_surfaces(const std::vector<int>& surfaces = {}, const std::map<int, Patch>& before = {});

/// Surfaces of the current model by tag, each as one patch without constraints, to measure another mesh of them
/// against. Those that have no orientation or are no manifolds are not there.
QMORPH_API std::map<int, Patch> read_surfaces(const std::vector<int>& surfaces = {});

/// Splits edges of curves, and the triangles beside them, so that every region (see `convert()`) gets an even number of
/// sides: `recombine()` leaves no triangle then. It is the only call that changes curves. Existing nodes stay.
/// \param surfaces as for `recombine()`; others, and edges that they share, stay as they are
/// \param keep_curves tags of curves that get no node
/// \throws UsageError for a surface or a curve that the model does not have; InputError as `recombine()` does. The
///         model is unchanged then.
QMORPH_API EvenReport make_even(const std::vector<int>& surfaces = {}, const std::vector<int>& keep_curves = {});

}  // namespace session
}  // namespace qmorph

namespace gmsh {
using namespace qmorph::session;
}

namespace qmorph {
namespace gmsh = ::gmsh;
}
