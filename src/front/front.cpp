#include "front/front.hpp"

#include <cmath>
#include <numbers>

namespace qmorph::front {
namespace {

constexpr int kForced = 0;

/// Four classes an octave; exact, so that no rounding of a logarithm decides.
std::int16_t length_class(double length) {
  int exponent = 0;
  const double mantissa = std::frexp(length, &exponent);  // in [0.5, 1)
  return std::int16_t(4 * exponent + int((mantissa - 0.5) * 8));
}

}  // namespace

Front::Front(const Mesh& mesh, const FrontOptions& options)
    : mesh_(mesh), options_(options), corner_cosine_(std::cos(options.corner_angle)) {}

Index Front::next(Index h) const {
  Index e = mesh_.next(h);
  while (mesh_.is_triangle(mesh_.face(Mesh::twin(e)))) e = mesh_.rotate_cw(e);
  return e;
}

Index Front::prev(Index h) const {
  Index e = mesh_.prev(h);
  while (mesh_.is_triangle(mesh_.face(Mesh::twin(e)))) e = mesh_.prev(Mesh::twin(e));
  return e;
}

double Front::angle_between(Index incoming, Index outgoing) const {
  const Vec2 back = -mesh_.vector(incoming), ahead = mesh_.vector(outgoing);
  const double angle = ccw_angle(ahead, back);
  // The two sides of a slit have the same direction at its tip: the wedge there is the whole circle.
  return angle > 0 ? angle : 2 * std::numbers::pi;
}

State Front::state(Index h) const {
  // Compared by cosines: no inverse trigonometry, whose last bit differs between machines.
  const auto is_corner = [&](Index incoming, Index outgoing) {
    const Vec2 back = -mesh_.vector(incoming), ahead = mesh_.vector(outgoing);
    if (cross(ahead, back) < 0) return false;
    const double dot = ahead.dot(back);
    if (cross(ahead, back) == 0 && dot > 0) return false;
    return dot > corner_cosine_ * std::sqrt(ahead.squaredNorm() * back.squaredNorm());
  };
  return {is_corner(prev(h), h), is_corner(h, next(h))};
}

void Front::push(Index h, bool forced) {
  if (h >= queued_.size()) queued_.resize(mesh_.half_edge_slots());
  const Key key{level(h), std::uint16_t(forced ? kForced : 3 - state(h).corners()), length_class(mesh_.length(h))};
  Queued& queued = queued_[h];
  if (queued.is_queued && queued.key == key) return;
  queued = {key, true};
  queue_.push({key, h});
}

void Front::push_around(Index v) {
  Index h = mesh_.out(v);
  do {
    if (contains(h)) push(h);
    if (contains(Mesh::twin(h))) push(Mesh::twin(h));
    h = mesh_.rotate_ccw(h);
  } while (h != mesh_.out(v));
}

Index Front::pop() {
  while (!queue_.empty()) {
    const Entry top = queue_.top();
    queue_.pop();
    Queued& queued = queued_[top.half_edge];
    if (!queued.is_queued || queued.key != top.key) continue;
    queued.is_queued = false;
    if (!mesh_.is_live_half_edge(top.half_edge) || !contains(top.half_edge)) continue;
    popped_forced_ = top.key.priority == kForced;
    return top.half_edge;
  }
  return kNone;
}

}  // namespace qmorph::front
