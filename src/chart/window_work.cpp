// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/window_work.hpp"

#include <algorithm>
#include <memory>
#include <numeric>

#include "cleanup/replace_cavities.hpp"
#include "engine/budget.hpp"
#include "engine/pipeline.hpp"
#include "stretch/window.hpp"

namespace qmorph::chart {
namespace {

struct Shapes {
  std::size_t bad = 0;
  double mean = 0;  ///< of scaled Jacobians

  explicit Shapes(const kernel::Mesh& mesh) {
    std::size_t faces = 0;
    for (Index f = 0; f < mesh.face_slots(); ++f) {
      if (!mesh.is_live_face(f)) continue;
      bad += !mesh.is_valid_face(f);
      mean += mesh.smallest_sine(f);
      ++faces;
    }
    if (faces > 0) mean /= double(faces);
  }
};

/// Of a node of a window that is stretched.
constexpr std::size_t kWorkToUnfold = 1000;

class WindowWork {
 public:
  WindowWork(const LaidOut& window, const Options& options, const Ground& ground, double allowed)
      : window_(window),
        background_(ground.background),
        options_(options),
        stretched_(stretch::StretchedWindow::of(window, ground)),
        work_{&window.piece, stretched_ ? stretched_->mesh() : window.piece.mesh(window.chart.flat()), {}},
        before_(work_.mesh),
        nodes_(window.piece.points.size()),
        allowed_(std::min(allowed, allowance(work_.mesh.face_slots()))) {
    std::iota(nodes_.begin(), nodes_.end(), 0);
    options_.observer = nullptr;
    options_.progress = {};
  }

  void clean() {
    Pipeline pipeline(options_, report_, record_, work_.mesh, allowed_);
    pipeline.clean_near(work_.mesh, nodes_);
    pipeline.polish(work_.mesh);
  }

  /// False if nothing has changed.
  bool cancel() {
    const cleanup::CavityLimits wide{
        .most_quads = 400, .most_nodes = 12, .most_tries = 20, .iterations = 12, .size = {0.9, 1.15}};
    const kernel::Budget budget(work_.mesh, std::size_t(allowed_));
    if (cleanup::replace_cavities_near(work_.mesh, options_.smoothing, nodes_, budget, wide) == 0) return false;
    Pipeline(options_, report_, record_, work_.mesh, allowed_).polish(work_.mesh);
    return true;
  }

  std::size_t work() const { return work_.mesh.work() + (stretched_ ? kWorkToUnfold * nodes_.size() : 0); }

  WindowResult result(double mean_loss) {
    const Shapes after(work_.mesh);
    const auto& [piece, chart] = window_;
    const std::size_t work = this->work();
    if (after.bad > before_.bad || after.mean < before_.mean - mean_loss || folds_onto_itself(work_.mesh, piece))
      return {{}, work};
    if (stretched_ && !stretched_->bring_back_straightened(work_.mesh)) return {{}, work};
    work_.lifted = lift(work_.mesh, piece, chart, background_);
    return {std::move(work_), work};
  }

 private:
  const LaidOut& window_;
  const space::Background& background_;
  Options options_;
  const std::unique_ptr<const stretch::StretchedWindow> stretched_;  ///< null if it is not
  Reworked work_;
  const Shapes before_;
  std::vector<Index> nodes_;
  const double allowed_;
  ConversionReport report_;
  Record record_;
};

}  // namespace

WindowResult clean_window(const LaidOut& window, const Options& options, const Ground& ground, double allowed) {
  WindowWork work(window, options, ground, allowed);
  constexpr double kAny = 1;
  work.clean();
  return work.result(kAny);
}

WindowResult cancel_in_window(const LaidOut& window, const Options& options, const Ground& ground, double allowed) {
  constexpr double kMeanLoss = 0.005;  // of the scaled Jacobian
  WindowWork work(window, options, ground, allowed);
  if (!work.cancel()) return {{}, work.work()};
  return work.result(kMeanLoss);
}

}  // namespace qmorph::chart
