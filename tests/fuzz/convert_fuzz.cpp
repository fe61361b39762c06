// SPDX-License-Identifier: GPL-2.0-or-later
// libFuzzer makes meshes of bytes: a conversion keeps its promises or is refused with an error of ours.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>

#include "qmorph/convert.hpp"
#include "qmorph/error.hpp"
#include "support/invariants.hpp"

namespace {

using namespace qmorph;

/// The bytes, one after another; zeros when they are used up.
class Bytes {
 public:
  explicit Bytes(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  bool is_empty() const { return bytes_.empty(); }
  unsigned next() {
    if (bytes_.empty()) return 0;
    const unsigned byte = bytes_.front();
    bytes_ = bytes_.subspan(1);
    return byte;
  }
  Index below(std::size_t count) { return count ? Index(next() % count) : 0; }
  /// From -1 to 1.
  double share() { return (double(next()) - 128) / 128; }

 private:
  std::span<const std::uint8_t> bytes_;
};

/// A grid whose nodes are moved and whose triangles are missing or turned over here and there.
Patch spoilt_grid(Bytes& in) {
  const Index columns = 1 + in.below(8), rows = 1 + in.below(8);
  const double jitter = 0.6 * double(in.next()) / 255, height = 3 * double(in.next()) / 255;
  Patch patch;
  for (Index j = 0; j <= rows; ++j)
    for (Index i = 0; i <= columns; ++i)
      patch.points.emplace_back(double(i) + jitter * in.share(), double(j) + jitter * in.share(), height * in.share());
  for (Index j = 0; j < rows; ++j)
    for (Index i = 0; i < columns; ++i) {
      const Index a = j * (columns + 1) + i, b = a + 1, c = b + columns + 1, d = c - 1;
      const unsigned what = in.next();
      if (what == 255) continue;
      if (what == 254) {
        patch.quads.push_back({a, b, c, d});
        continue;
      }
      patch.triangles.push_back(what % 2 ? std::array{a, b, c} : std::array{a, b, d});
      patch.triangles.push_back(what % 2 ? std::array{a, c, d} : std::array{b, c, d});
      if (what == 253) std::swap(patch.triangles.back()[0], patch.triangles.back()[1]);
    }
  return patch;
}

/// Any triangles at all.
Patch soup(Bytes& in) {
  Patch patch;
  const std::size_t points = 3 + in.below(12);
  for (std::size_t i = 0; i < points; ++i) patch.points.emplace_back(in.share(), in.share(), in.share());
  const std::size_t triangles = in.below(24);
  for (std::size_t t = 0; t < triangles; ++t)
    patch.triangles.push_back({in.below(points + 1), in.below(points), in.below(points)});
  return patch;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes in({data, size});
  Patch patch = in.next() % 8 ? spoilt_grid(in) : soup(in);
  while (!in.is_empty() && patch.constraints.size() < 4)
    patch.constraints.push_back({in.below(patch.points.size()), in.below(patch.points.size())});
  Options options;
  options.threads = 1;
  options.retry_triangles = 0;  // more of the same, which takes most of the time
  try {
    const QuadMesh mesh = convert(patch, options).mesh;
    const auto broken = test::broken_invariants(patch, mesh);
    if (broken.empty()) return 0;
    std::fprintf(stderr, "%s\n", broken.front().c_str());
    std::abort();
  } catch (const Error&) {
    return 0;
  }
}
