#pragma once
/// The advancing front as a whole. Thesis chapter 2, [Owen99].

#include <functional>

#include "front/film_recorder.hpp"
#include "kernel/mesh.hpp"
#include "qmorph/options.hpp"

namespace qmorph::front {

/// How often each step was taken.
struct MorphCounts {
  std::size_t quads = 0, seams = 0, transition_seams = 0, transition_splits = 0, small_loops = 0;
  std::size_t set_aside = 0;
};

/// Turns triangles into quads from the boundary inwards. Every element of the mesh is valid before and after;
/// triangles that no step can take are left for triangle elimination. Linear but for the queue.
/// `progress` is called now and then with the share of triangles done; `recorder`, which may be null, sees every step.
MorphCounts morph(kernel::Mesh& mesh, const FrontOptions& options, bool check_each_step = false,
                  const std::function<void(double)>& progress = {}, FilmRecorder* recorder = nullptr);

}  // namespace qmorph::front
