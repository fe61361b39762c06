#pragma once
/// The advancing front as a whole. Thesis chapter 2, [Owen99].

#include <functional>

#include "front/film_recorder.hpp"
#include "kernel/mesh.hpp"
#include "qmorph/options.hpp"

namespace qmorph::front {

/// Turns triangles into quads from the boundary inwards. Every element of the mesh is valid before and after;
/// triangles that no step can take are left for triangle elimination. Linear but for the queue.
/// `progress` is called now and then with the share of triangles done; `recorder`, which may be null, sees every step.
void morph(kernel::Mesh& mesh, const FrontOptions& options, bool check_each_step = false,
           const std::function<void(double)>& progress = {}, FilmRecorder* recorder = nullptr);

}  // namespace qmorph::front
