// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What an observer is told in the end. Until then it is kept beside the result: a try that is not taken leaves no
/// trace.

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "kernel/mesh.hpp"
#include "qmorph/observer.hpp"
#include "qmorph/options.hpp"

namespace qmorph {

inline bool wants_stages(const Options& options) { return options.observer && options.observer->wants_stages(); }

/// Of one region, or of a part of one.
struct Record {
  std::array<std::optional<kernel::Mesh>, kStages> stages;  ///< as it was after each; empty if nobody wants that
  std::array<double, kStages> seconds{};
  std::vector<std::unique_ptr<FrontObserver>> fronts;

  /// Takes times and fronts of a part.
  void add(Record& part);
};

/// Of a surface.
struct SurfaceRecord {
  std::vector<QuadMesh> stages;  ///< one for each, or none
  std::array<double, kStages> seconds{};
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  std::vector<double> size_ratios;
  std::vector<std::unique_ptr<FrontObserver>> fronts;

  void tell(Observer& observer, std::size_t surface);
};

/// Passes everything on, with the number of a surface.
class NumberedObserver : public Observer {
 public:
  NumberedObserver(Observer& observer, std::size_t surface) : observer_(observer), surface_(surface) {}
  std::unique_ptr<FrontObserver> front_starts(const FrontStart& start) override {
    FrontStart numbered = start;
    numbered.surface = surface_;
    return observer_.front_starts(numbered);
  }
  bool wants_stages() const override { return observer_.wants_stages(); }

 private:
  Observer& observer_;
  std::size_t surface_;
};

}  // namespace qmorph
