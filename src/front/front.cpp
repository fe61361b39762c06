// SPDX-License-Identifier: GPL-2.0-or-later
#include "front/front.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <utility>

namespace qmorph::front {
namespace {

constexpr unsigned kForced = 0;
/// Bits of a key, from the lowest: length class, priority, level.
constexpr int kPriorityShift = 14, kLevelShift = 16;
constexpr unsigned kMostLevels = 0xffff;

/// Four classes an octave: exponent and leading two bits of the mantissa. Exact, so that no rounding of a logarithm
/// decides.
unsigned length_class(double length) { return unsigned(std::bit_cast<std::uint64_t>(length) >> 50); }

bool is_forced(std::uint32_t key) { return (key >> kPriorityShift & 3) == kForced; }

}  // namespace

Front::Front(const Mesh& mesh, const FrontOptions& options, Decisions* decisions)
    : mesh_(mesh), decisions_(decisions), corner_cosine_(std::cos(options.corner_angle)) {}

double Front::angle_between(Index incoming, Index outgoing) const {
  const Vec2 back = -mesh_.vector(incoming), ahead = mesh_.vector(outgoing);
  const double angle = ccw_angle(ahead, back);
  // The two sides of a slit have the same direction at its tip: the wedge there is the whole circle.
  return angle > 0 ? angle : 2 * std::numbers::pi;
}

bool Front::is_angle_below(Index incoming, Index outgoing, double limit) const {
  const Vec2 back = -mesh_.vector(incoming), ahead = mesh_.vector(outgoing);
  if (limit <= 0.5 * std::numbers::pi && (ahead.dot(back) < 0 || cross(ahead, back) < 0)) return false;
  return angle_between(incoming, outgoing) < limit;
}

bool Front::is_corner(Index incoming, Index outgoing) const {
  // Compared by squares of cosines with their signs: no inverse trigonometry, whose last bit differs between machines.
  const Vec2 back = -mesh_.vector(incoming), ahead = mesh_.vector(outgoing);
  const double area = cross(ahead, back), dot = ahead.dot(back);
  if (area < 0 || (area == 0 && dot > 0)) return false;
  const double aa = ahead.squaredNorm(), bb = back.squaredNorm();
  const bool is_corner = signed_square(dot) > signed_square(corner_cosine_) * aa * bb;
  if (decisions_) decisions_->corner.note(signed_square(dot) / (aa * bb), !is_corner);
  return is_corner;
}

Base Front::look_at(Index h) const {
  const Index before = prev(h), after = next(h);
  return {h, before, after, {is_corner(before, h), is_corner(h, after)}};
}

Front::Key Front::key_of(unsigned level, unsigned priority, double length) {
  return std::min(level, kMostLevels) << kLevelShift | priority << kPriorityShift | length_class(length);
}

Index Front::new_entry(Index h) {
  if (unused_ == kNone) {
    entries_.push_back({h, kNone});
    return Index(entries_.size() - 1);
  }
  const Index entry = std::exchange(unused_, entries_[unused_].next);
  entries_[entry] = {h, kNone};
  return entry;
}

void Front::push(Index h, State state, bool forced) {
  if (h >= queued_.size()) queued_.resize(mesh_.half_edge_slots());
  const Key key = key_of(level(h), forced ? kForced : unsigned(3 - state.corners()), mesh_.length(h));
  if (std::exchange(queued_[h], key) == key) return;
  const Index entry = new_entry(h);
  const auto line =
      std::lower_bound(lines_.begin(), lines_.end(), key, [](const Line& one, Key wanted) { return one.key > wanted; });
  if (line == lines_.end() || line->key != key)
    lines_.insert(line, {key, entry, entry});
  else
    line->last = entries_[line->last].next = entry;
}

Index Front::pop() {
  while (!lines_.empty()) {
    Line& line = lines_.back();
    const Key key = line.key;
    const Index entry = line.first, h = entries_[entry].half_edge;
    line.first = entries_[entry].next;
    entries_[entry].next = std::exchange(unused_, entry);
    if (line.first == kNone) lines_.pop_back();
    if (queued_[h] != key) continue;
    queued_[h] = 0;
    if (!mesh_.is_live_half_edge(h) || !contains(h)) continue;
    popped_forced_ = is_forced(key);
    return h;
  }
  return kNone;
}

}  // namespace qmorph::front
