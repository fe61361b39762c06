#pragma once
/// Writes down what the front does, for those who want to watch it.

#include <memory>

#include "front/front.hpp"
#include "kernel/mesh.hpp"
#include "qmorph/film.hpp"

namespace qmorph::front {

/// What the steps say about themselves while they work. Kept whether anybody watches or not.
struct StepNotes {
  SideEdge left = SideEdge::front, right = SideEdge::front;
  SideEdge side = SideEdge::existing;  ///< of the last define_side_edge()
  unsigned swaps = 0;                  ///< of the last recover_edge()
  bool met_front = false;
};

class FilmRecorder {
 public:
  /// Takes the mesh as it is for the start.
  FilmRecorder(const kernel::Mesh& mesh, double corner_angle);

  /// To be called after the commit of a step. Cost: that of the step.
  void record(FilmStep kind, Index base_origin, Index base_target, const StepNotes& notes, Front& front);

  /// In the plane's coordinates; `Film::origin` and the axes are along x and y of it.
  std::shared_ptr<Film> finish() { return std::move(film_); }

 private:
  struct Level {
    Index origin = kNone, target = kNone;
    unsigned level = 0;
  };
  using Place = std::array<std::int32_t, 2>;

  Place place(Index v) const;
  void put(std::uint64_t number);
  void put_signed(std::int64_t number);
  void put_near(Index v) { put_signed(std::int64_t(v) - std::int64_t(near_)); }
  void record_nodes();
  void record_faces();
  void record_levels(Front& front);

  const kernel::Mesh& mesh_;
  std::shared_ptr<Film> film_;
  Eigen::Vector2d corner_;
  double quantum_;
  std::vector<Place> places_;  ///< as last recorded
  std::vector<bool> seen_;
  std::vector<std::array<Index, 4>> faces_;
  std::vector<Level> levels_;
  std::vector<Index> changed_;
  Index near_ = 0;
};

}  // namespace qmorph::front
