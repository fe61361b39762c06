#pragma once
/// The door for programs that already run the Gmsh API: the stand-in for `gmsh::model::mesh::recombine()`.
/// Mentions no Gmsh type; link `qmorph_gmsh`.

#include <cstddef>
#include <string>
#include <vector>

#include "qmorph/error.hpp"
#include "qmorph/options.hpp"
#include "qmorph/patch.hpp"
#include "qmorph/quality.hpp"

namespace qmorph {

/// What became of one surface.
enum class SurfaceOutcome {
  kConverted,     ///< its triangles are quads now
  kAlreadyQuads,  ///< it had no triangle and is as it was
  kLeft,          ///< it could not be converted and is as it was; `reason` says why
};

/// One surface, before and after.
struct SurfaceReport {
  int tag = 0;
  std::string name;  ///< of its first physical group, or empty
  SurfaceOutcome outcome = SurfaceOutcome::kLeft;
  std::string reason;                 ///< of kLeft: what is wrong, where, and what to do
  std::vector<std::string> warnings;  ///< of a surface that was converted all the same
  std::size_t triangles_in = 0, quads_in = 0;
  std::size_t triangles_out = 0, quads_out = 0;
  Quality quality;  ///< of what came out; all defaults for kLeft
  ConversionStats stats;
  double seconds = 0;
};

/// The whole model.
struct ModelReport {
  std::vector<SurfaceReport> surfaces;  ///< by tag; surfaces without an element are not listed
  std::vector<std::string> warnings;
  Quality total;  ///< of the converted and the all-quad surfaces together
  double read_seconds = 0, convert_seconds = 0, check_seconds = 0, replace_seconds = 0;

  std::size_t count(SurfaceOutcome outcome) const;
};

/// Turns the triangles of surfaces of the current Gmsh model into quads, in place.
///
/// Line elements, point elements, curve nodes, physical groups, entities and all other surfaces stay as they are;
/// new nodes and elements get tags that nothing else has. A surface that cannot be converted is left as it
/// was and reported as kLeft.
/// \param surfaces tags of the surfaces to convert; all if empty. A tag that the model does not have is a
///        UsageError.
/// \pre Gmsh is initialised, and called from this thread only. Gmsh's logger is not running.
/// \throws UsageError, InputError if the mesh of the model contradicts itself; the model is unchanged then.
/// Cost: linear in the size of the model.
ModelReport recombine(const std::vector<int>& surfaces = {}, const Options& options = {});

/// The same for surfaces that consist of quads already, or of quads and triangles, as Gmsh's own recombination leaves
/// them: all their elements may change, and what comes out has better quads (see `improve()` of qmorph/convert.hpp).
/// Surfaces come out as kConverted or kLeft.
ModelReport improve_quads(const std::vector<int>& surfaces = {}, const Options& options = {});

/// Figures of surfaces as they are; nothing changes. Surfaces come out as kAlreadyQuads, whatever they consist of, those
/// that have no figures (not a manifold, no orientation) with a reason.
ModelReport measure(const std::vector<int>& surfaces = {});

}  // namespace qmorph
