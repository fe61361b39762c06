#include "engine/convert_region.hpp"

#include <algorithm>

#include "engine/ear.hpp"
#include "engine/fans.hpp"
#include "engine/prepare.hpp"
#include "qmorph/error.hpp"

namespace qmorph {
namespace {

/// What the stages made of a region.
struct Attempt {
  kernel::Mesh mesh;
  ConversionStats stats;
  Snapshots snapshots;
  std::string fault;
};

/// 2 a x b / (a^2 + b^2) with the edges a and b of a corner, at the element's worst corner: 1 for a square. [Knupp01]
double shape(const kernel::Mesh& mesh, Index f) {
  double least = 1;
  Index h = mesh.half_edge(f);
  for (Index i = 0; i < mesh.degree(f); ++i, h = mesh.next(h)) {
    const Vec2 a = mesh.vector(h), b = -mesh.vector(mesh.prev(h));
    least = std::min(least, 2 * cross(a, b) / (a.squaredNorm() + b.squaredNorm()));
  }
  return least;
}

struct Worth {
  double least = 1;  ///< smallest scaled Jacobian of a quad
  double mean = 0;   ///< of shapes
  /// Once the worst quad is good enough for every solver, the others count.
  double sum() const { return std::min(least, kGoodEnough) + 2 * mean; }
  static constexpr double kGoodEnough = 0.4;
};

Worth worth_of(const kernel::Mesh& mesh) {
  Worth worth;
  std::size_t faces = 0;
  for (Index f = 0; f < mesh.face_slots(); ++f) {
    if (!mesh.is_live_face(f)) continue;
    if (mesh.is_quad(f)) worth.least = std::min(worth.least, mesh.smallest_sine(f));
    worth.mean += shape(mesh, f), ++faces;
  }
  if (faces > 0) worth.mean /= double(faces);
  return worth;
}

/// The constants around those that the caller asked for.
std::vector<FrontOptions> variants_of(const FrontOptions& asked) {
  std::vector<FrontOptions> variants;
  for (double corner : {1.0, 0.9, 1.1})
    for (double side : {1.0, 0.5, 1.5})
      for (double transition : {1.0, 0.7})
        for (double seam : {1.0, 0.5}) {
          FrontOptions front = asked;
          front.corner_angle *= corner;
          front.side_edge_angle *= side;
          front.transition_ratio *= transition;
          front.seam_angle *= seam;
          front.seam_angle_many *= seam;
          variants.push_back(front);
        }
  variants.erase(variants.begin());  // as asked
  return variants;
}

class RegionConverter {
 public:
  RegionConverter(const Region& region, const Plane& plane, const Options& options, const ConversionStats& before)
      : region_(region),
        plane_(plane),
        options_(options),
        before_(before),
        start_(region.points, region.triangles, region.open) {
    for (Index v : region.fixed) start_.set_fixed(v);
    if (options.measure_stages) input_ = start_;
    repair_input(start_, plane);
    grade_fans(start_);
  }

  Attempt run() {
    std::string fault = find_needles(start_, plane_);
    if (fault.empty()) {
      Attempt first = attempt(options_, true);
      if (first.fault.empty()) return best_of_variants(std::move(first));
      fault = first.fault;
    }
    // A front has no room in fans and needles. Pairing the triangles as they are often has.
    Attempt paired = attempt(options_, false);
    if (!paired.fault.empty()) throw SurfaceError(fault);
    return paired;
  }

 private:
  Attempt best_of_variants(Attempt best) {
    // Under the lower bound it is the boundary that is poor, and no try changes that.
    constexpr double kGood = 2.2, kHopeless = 0.05;
    constexpr std::size_t kMostGrowth = 2, kFew = 20;  // a front that makes many more faces than that has gone astray
    const std::size_t size = count_faces(start_, 3);   // fans may have been refined
    std::size_t triangles = size;
    if (2 * triangles > options_.retry_triangles) return best;
    Worth worth = worth_of(best.mesh);
    if (worth.least < kHopeless) return best;
    for (const FrontOptions& front : variants_of(options_.front)) {
      triangles += size;
      if (triangles > options_.retry_triangles || worth.sum() > kGood) break;
      Options options = options_;
      options.front = front;
      Attempt other = attempt(options, true, kMostGrowth * (count_faces(best.mesh, 4) + kFew));
      const Worth others = worth_of(other.mesh);
      if (!other.fault.empty() || others.sum() <= worth.sum()) continue;
      best = std::move(other);
      worth = others;
    }
    return best;
  }

  Attempt attempt(const Options& options, bool with_front, std::size_t most_faces = std::size_t(-1)) {
    Attempt result{start_, before_, {}, {}};
    Pipeline pipeline(options, result.stats, options.measure_stages ? &result.snapshots : nullptr, input_);
    if (with_front) pipeline.advance_front(result.mesh);
    if (count_faces(result.mesh, 3) + count_faces(result.mesh, 4) > most_faces) {
      result.fault = "too many elements";
      return result;
    }
    pipeline.finish(result.mesh);
    result.fault = find_fault(result.mesh, region_, plane_);
    return result;
  }

  const Region& region_;
  const Plane& plane_;
  const Options& options_;
  const ConversionStats& before_;
  kernel::Mesh start_;  ///< what the front begins with
  kernel::Mesh input_;  ///< as it came, if stages are measured
};

/// The same with an ear set aside: the one triangle that an odd boundary leaves.
std::optional<Attempt> convert_without_ear(const Region& region, const Plane& plane, const Options& options,
                                           const ConversionStats& before) {
  if (region.boundary_sides % 2 == 0 || 2 * region.triangles.size() > options.retry_triangles) return {};
  const std::optional<Ear> ear = sharpest_ear(region);
  if (!ear) return {};
  try {
    const Region rest = cut_off(region, *ear);
    Attempt result = RegionConverter(rest, plane, options, before).run();
    put_back(result.mesh, *ear);
    ++result.stats.leftover_triangles;  // the front leaves the ear, too
    for (auto& snapshot : result.snapshots)
      if (snapshot) put_back(*snapshot, *ear);
    return result;
  } catch (const SurfaceError&) {
    return {};
  }
}

}  // namespace

kernel::Mesh convert_region(const Region& region, const Plane& plane, const Options& options, ConversionStats& stats,
                            Snapshots* snapshots) {
  Attempt best = RegionConverter(region, plane, options, stats).run();
  if (auto other = convert_without_ear(region, plane, options, stats))
    if (worth_of(other->mesh).sum() > worth_of(best.mesh).sum()) best = std::move(*other);
  stats = std::move(best.stats);
  if (snapshots) *snapshots = std::move(best.snapshots);
  return std::move(best.mesh);
}

}  // namespace qmorph
