// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/canonical/frame.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "geometry/mixed_bits.hpp"

namespace qmorph::canonical {
namespace {

using Eigen::Vector3d;

/// Moments of the middles, in a box from -1 to 1 around the surface, that differ by less are the same but for rounding.
constexpr double kSame = 1e-9;

using Powers = std::array<int, 3>;
/// What decides, one after another: which way the surface is longest, on which side its elements are finer, ...
constexpr std::array<Powers, 18> kMoments{{{2, 0, 0},
                                           {0, 2, 0},
                                           {1, 0, 0},
                                           {0, 1, 0},
                                           {0, 0, 1},
                                           {1, 1, 0},
                                           {1, 0, 1},
                                           {0, 1, 1},
                                           {3, 0, 0},
                                           {2, 1, 0},
                                           {2, 0, 1},
                                           {1, 2, 0},
                                           {0, 3, 0},
                                           {0, 2, 1},
                                           {1, 0, 2},
                                           {0, 1, 2},
                                           {0, 0, 3},
                                           {1, 1, 1}}};

template <class Visit>
void for_each_element(const Patch& patch, const Visit& visit) {
  for (const auto& t : patch.triangles) visit(t);
  for (const auto& q : patch.quads) visit(q);
}

struct Box {
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;

  explicit Box(const Patch& patch) {
    for (const Vector3d& p : patch.points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  }
  Vector3d centre() const { return 0.5 * low + 0.5 * high; }
  Vector3d sizes() const { return high - low; }
  double size() const { return sizes().maxCoeff(); }
};

/// Sums over the elements, in the model's axes and in units of half the box.
class Moments {
 public:
  Moments(const Patch& patch, const Box& box) {
    const double scale = box.size() > 0 ? 2 / box.size() : 0;
    const Vector3d centre = box.centre();
    for_each_element(patch, [&](const auto& element) {
      const Vector3d a = (patch.points[element[0]] - centre) * scale, b = (patch.points[element[1]] - centre) * scale,
                     c = (patch.points[element[2]] - centre) * scale;
      Vector3d middle = a + b + c;
      add_area(a, b, c);
      if (element.size() == 4) {
        const Vector3d d = (patch.points[element.back()] - centre) * scale;
        middle += d;
        add_area(a, c, d);
      }
      add(middle / double(element.size()));
    });
    for (auto& plane : sums_)
      for (auto& line : plane)
        for (double& sum : line) sum /= double(patch.triangles.size() + patch.quads.size());
  }

  double operator[](const Powers& powers) const {
    return sums_[std::size_t(powers[0])][std::size_t(powers[1])][std::size_t(powers[2])];
  }
  const Vector3d& area() const { return area_; }
  double volume() const { return volume_; }

 private:
  void add(const Vector3d& p) {
    const double x = p.x(), y = p.y(), z = p.z(), xx = x * x, yy = y * y, zz = z * z;
    auto& s = sums_;
    s[1][0][0] += x, s[0][1][0] += y, s[0][0][1] += z;
    s[2][0][0] += xx, s[0][2][0] += yy, s[0][0][2] += zz, s[1][1][0] += x * y, s[1][0][1] += x * z, s[0][1][1] += y * z;
    s[3][0][0] += xx * x, s[0][3][0] += yy * y, s[0][0][3] += zz * z, s[1][1][1] += x * y * z;
    s[2][1][0] += xx * y, s[2][0][1] += xx * z, s[1][2][0] += x * yy;
    s[0][2][1] += yy * z, s[1][0][2] += x * zz, s[0][1][2] += y * zz;
  }
  void add_area(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    const Vector3d area = (b - a).cross(c - a);
    area_ += area;
    volume_ += a.dot(area);
  }

  std::array<std::array<std::array<double, 4>, 4>, 4> sums_{};  ///< by powers of x, y and z
  Vector3d area_ = Vector3d::Zero();                            ///< twice the area, along the normal
  double volume_ = 0;                                           ///< six times what a closed surface encloses
};

double moment_along(const Moments& moments, const Frame& frame, const Powers& powers) {
  Powers in_model{};
  double sign = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    in_model[std::size_t(frame.axis[i])] = powers[i];
    if (powers[i] % 2 != 0) sign *= frame.sign[i];
  }
  return sign * moments[in_model];
}

/// All ways to exchange and turn the axes, the model's own first. Across a surface that is flat along an axis there is
/// no other way.
std::vector<Frame> all_frames(const Box& box) {
  std::vector<Frame> frames;
  Frame frame;
  do {
    for (unsigned turned = 0; turned < 8; ++turned) {
      bool is_new = true;
      for (std::size_t i = 0; i < 3; ++i) {
        const int k = frame.axis[i];
        const bool is_flat = box.low[k] == box.high[k], is_turned = (turned >> i & 1) != 0;
        frame.sign[i] = is_turned ? -1 : 1;
        frame.origin[i] = is_flat ? box.low[k] : 0;
        is_new = is_new && !(is_flat && is_turned);
      }
      if (is_new) frames.push_back(frame);
    }
  } while (std::next_permutation(frame.axis.begin(), frame.axis.end()));
  return frames;
}

void keep_largest(std::vector<Frame>& frames, const Moments& moments, const Powers& powers) {
  std::vector<double> values;
  for (const Frame& frame : frames) values.push_back(moment_along(moments, frame, powers));
  const double least = *std::max_element(values.begin(), values.end()) - kSame;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < frames.size(); ++i)
    if (values[i] >= least) frames[kept++] = frames[i];
  frames.resize(kept);
}

/// A number for the surface's coordinates in a frame that does not depend on how nodes and elements are numbered, nor
/// on which way elements run round, nor on powers of two in scale.
std::uint64_t fingerprint(const Patch& patch, const Frame& frame, double size) {
  const double unit = std::exp2(std::ilogb(size));
  std::vector<std::uint64_t> nodes;
  nodes.reserve(patch.points.size());
  for (const Vector3d& point : patch.points) {
    const Vector3d p = frame.to_own(point) / unit;
    std::uint64_t node = 0;
    for (Eigen::Index i = 0; i < 3; ++i) node = mixed_bits(node ^ std::bit_cast<std::uint64_t>(p[i]));
    nodes.push_back(node);
  }
  std::uint64_t all = 0;
  for_each_element(patch, [&](const auto& element) {
    std::uint64_t sum = 0;
    for (Index v : element) sum += nodes[v];
    all += mixed_bits(sum);
  });
  for (const auto& [a, b] : patch.constraints) all += mixed_bits(mixed_bits(nodes[a] + nodes[b]));
  for (Index v : patch.fixed) all += mixed_bits(mixed_bits(nodes[v]));
  return all;
}

/// So that the surface is seen from the side of its normal, if it has one: the same side from wherever its elements
/// are.
bool is_seen_from_behind(const Moments& moments, const Frame& frame) {
  for (std::size_t i : {2, 1, 0}) {
    const double area = frame.sign[i] * moments.area()[frame.axis[i]];
    if (std::abs(area) > kSame) return frame.handedness() * area < 0;
  }
  if (std::abs(moments.volume()) > kSame) return frame.handedness() * moments.volume() < 0;
  return frame.handedness() < 0;
}

}  // namespace

Vector3d Frame::to_own(const Vector3d& model) const {
  Vector3d own;
  for (std::size_t i = 0; i < 3; ++i) {
    own[Eigen::Index(i)] = sign[i] * (model[axis[i]] - origin[i]) + 0.0;  // -0 is 0
  }
  return own;
}

Vector3d Frame::to_model(const Vector3d& own) const {
  Vector3d model;
  for (std::size_t i = 0; i < 3; ++i) model[axis[i]] = origin[i] + sign[i] * own[Eigen::Index(i)];
  return model;
}

Vector3d Frame::direction_to_model(const Vector3d& own) const {
  Vector3d model;
  for (std::size_t i = 0; i < 3; ++i) model[axis[i]] = sign[i] * own[Eigen::Index(i)];
  return model;
}

double Frame::handedness() const {
  const bool is_cyclic = (axis[0] + 1) % 3 == axis[1];
  return (is_cyclic ? 1 : -1) * sign[0] * sign[1] * sign[2];
}

Frame find_frame(const Patch& patch) {
  const Box box(patch);
  const Moments moments(patch, box);
  std::vector<Frame> frames = all_frames(box);
  for (const Powers& powers : kMoments) keep_largest(frames, moments, powers);
  std::vector<std::uint64_t> prints;
  if (frames.size() > 1 && box.size() > 0)
    for (const Frame& frame : frames) prints.push_back(fingerprint(patch, frame, box.size()));
  Frame frame =
      prints.empty() ? frames[0] : frames[std::size_t(std::min_element(prints.begin(), prints.end()) - prints.begin())];
  frame.turns_over = is_seen_from_behind(moments, frame);
  return frame;
}

}  // namespace qmorph::canonical
