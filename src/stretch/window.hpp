// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Work on a window of a stretched surface that is not flat.

#include <memory>
#include <optional>

#include "chart/divide.hpp"
#include "chart/ground.hpp"
#include "stretch/unfolded.hpp"

namespace qmorph::stretch {

/// A window, already laid flat, laid out again by a metric.
class StretchedWindow {
 public:
  /// Nothing if triangles are not stretched there, or if there is no such chart.
  static std::unique_ptr<const StretchedWindow> of(const chart::LaidOut& window, const chart::Ground& ground);

  /// The window's elements in this chart.
  kernel::Mesh mesh() const { return window_.piece.mesh(unfolded_->flat()); }
  /// Back to the window's own chart.
  void bring_back(kernel::Mesh& mesh) const { unfolded_->lift(mesh); }
  /// The same, and straightened. False if that has made an element invalid.
  bool bring_back_straightened(kernel::Mesh& mesh) const;

 private:
  StretchedWindow(const chart::LaidOut& window, const std::vector<LogMetric>& metrics);

  const chart::LaidOut& window_;
  Surface surface_;
  MetricField field_;
  std::optional<Unfolded> unfolded_;
};

}  // namespace qmorph::stretch
